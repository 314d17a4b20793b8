#pragma once

#include <nlohmann/json.hpp>

#include "core/design/design.h"

namespace rhombloom {

//! \brief Read one operation; \p path is its JSON path, for refusals.
Expected<Operation> read_operation(const nlohmann::json& value, const std::string& path);

nlohmann::ordered_json write_operation(const Operation& operation);

//! \brief Read the design's symmetry: {"mirror": [x, y, z]} or {"axis": [x, y, z], "fold": n}, with "through_mm".
Expected<Symmetry> read_symmetry(const nlohmann::json& value, const std::string& path);

nlohmann::ordered_json write_symmetry(const Symmetry& symmetry);

} // namespace rhombloom
