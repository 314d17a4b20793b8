#pragma once

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

//! \brief The join of a triangle mesh: one element per edge, an acute corner at each of its ends and an obtuse one in
//! each of its triangles. The sides alternate by construction, whatever the genus.
//! \details The first points are the triangles' corners, long sides leave them; then one point per triangle, in
//! \p target's surface above its middle. Boundary edges carry no element.
SurfaceLists join_network(const TriangleMesh& triangles, const MeshTree& target);

} // namespace rhombloom
