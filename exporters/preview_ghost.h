#pragma once

#include "core/design/mesh_import/triangle_mesh.h"
#include "exporters/gltf.h"

namespace rhombloom {

//! \brief The target of an import in few triangles, for those who look at it beside the elements.
//! \details At most \p most_points points, all of them points of \p target. A target that is no closed surface is left
//! as it is if it is small enough, otherwise the result is empty.
TriangleMesh ghost_of(const TriangleMesh& target, std::size_t most_points = 2500);

//! \brief A ghost as templates/viewer_ghost.js reads it: about 9 characters a point, to 1/4000 of its size.
//! \details Packed (packed_text) is: 4 bytes with the number of points, 4 with that of triangles, 3 floats of the
//! lowest corner in mm, a float with the step in mm; then per coordinate the differences from point to point in two
//! bytes, lowest bytes first, and the corners of the triangles as differences from the highest number so far plus one.
std::string packed_ghost(const TriangleMesh& ghost);

//! \brief Add a second scene "target" with the ghost to be seen through, its points and triangles as they are.
void add_plain_ghost(Glb& glb, const TriangleMesh& ghost);

} // namespace rhombloom
