#pragma once

#include <optional>

#include "core/design/design.h"
#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

//! \brief A target as it is stored beside a design: binary PLY named after its content.
struct TargetFile
{
    std::string name;
    std::string sha256;
    std::string bytes;
};

TargetFile target_file(const TriangleMesh& target);

//! \brief The targets of all imports of \p design in one mesh, mm, from the folder that the design is in; nothing when
//! no import names one.
//! \details Refuses, with the operation's number and the file's name: a file that is missing, or whose content is not
//! the one that the import was made from.
Expected<std::optional<TriangleMesh>> load_targets(const Design& design, const std::string& folder);

} // namespace rhombloom
