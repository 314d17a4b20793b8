#pragma once

#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

//! \brief Points within 1e-7 of the diagonal become one; what no triangle uses is dropped.
//! \details Triangles may end with equal corners. Points keep their order, but for large meshes: these are numbered
//! along a space-filling curve, so that what is near in space is near in memory.
void weld(TriangleMesh& mesh);

} // namespace rhombloom
