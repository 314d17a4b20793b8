#pragma once

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

struct RemeshOptions
{
    double edge = 1;    //!< length that all edges should have, in the mesh's unit
    int max_degree = 8; //!< most triangles at a vertex
    int rounds = 10;    //!< at the final length
};

//! \brief Triangles with sides of one length and degrees near 6 on the surface \p target, of the same topology as
//! \p start.
//! \details Botsch and Kobbelt 2004: split, collapse, flip, smooth along the surface, project; the length grows from
//! that of \p start step by step, so that thin limbs and handles are thinned out instead of cut off.
TriangleMesh remesh(const TriangleMesh& start, const MeshTree& target, const RemeshOptions& options);

//! \brief \p mesh in even triangles with sides of length \p edge, quickly: to be measured from, not to carry elements.
TriangleMesh evened(const MeshTree& mesh, double edge);

//! \brief Split the longest or collapse the shortest edges until \p mesh has about \p edges of them: three more or less
//! each time, so within two where nothing stands in the way.
TriangleMesh with_edge_count(const TriangleMesh& mesh, const MeshTree& target, int edges, const RemeshOptions& options);

} // namespace rhombloom
