#pragma once

#include <string>

#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

//! \brief Binary PLY (little endian): points as floats, triangles. read_mesh reads it again.
std::string write_ply(const TriangleMesh& mesh);

} // namespace rhombloom
