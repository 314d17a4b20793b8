#pragma once

#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

//! \brief Fewer triangles of the same topology, for questions that need no finer detail: edges shorter than \p edge are
//! collapsed towards one of their ends, so every point that is left is one of \p mesh.
//! \pre \p mesh is a closed oriented manifold.
TriangleMesh decimate(const TriangleMesh& mesh, double edge);

} // namespace rhombloom
