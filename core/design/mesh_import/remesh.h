#pragma once

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

struct RemeshOptions
{
    double edge = 1;    //!< length that all edges should have, in the mesh's unit
    int max_degree = 8; //!< most triangles at a vertex
};

//! \brief Triangles with sides of one length and degrees near 6 on the surface \p target, of the same topology as
//! \p start.
//! \details Botsch and Kobbelt 2004: split, collapse, flip, smooth along the surface, project; the length grows from
//! that of \p start step by step, so that thin limbs and handles are thinned out instead of cut off.
TriangleMesh remesh(const TriangleMesh& start, const MeshTree& target, const RemeshOptions& options);

} // namespace rhombloom
