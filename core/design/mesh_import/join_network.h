#pragma once

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

//! \brief The join of a triangle mesh: one element per edge, an acute corner at each of its ends and an obtuse one in
//! each of its triangles. The sides alternate by construction, whatever the genus.
//! \details The first points are the triangles' corners, long sides leave them; then one point per
//! triangle: \p middles. The elements are sorted by the numbers of their acute corners. Boundary edges carry no
//! element.
SurfaceLists join_network(const TriangleMesh& triangles, const std::vector<Vec3>& middles);

//! \brief The points of \p target nearest to the middles of \p triangles.
std::vector<Vec3> triangle_middles(const TriangleMesh& triangles, const MeshTree& target);

} // namespace rhombloom
