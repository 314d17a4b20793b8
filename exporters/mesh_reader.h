#pragma once

#include <string>

#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

//! \brief A mesh as it stands in a file: polygons cut into triangles, z up, nothing repaired.
struct MeshFile
{
    TriangleMesh mesh;   //!< points may be NaN or far away; indices are in range
    bool metres = false; //!< the format says so (glTF); else the unit is unknown
};

//! \brief Read a triangle or polygon mesh: OBJ, PLY (ascii and binary), STL (ascii and binary), OFF or GLB, told apart
//! by the ending of \p name.
//! \details Own readers: the libraries at hand (Assimp, OpenMesh, tinygltf) trust their input, and files here come from
//! anywhere. Refuses with the place: unknown endings, truncated files, indices without a point, no faces at all.
Expected<MeshFile> read_mesh(const std::string& name, const std::string& bytes);

} // namespace rhombloom
