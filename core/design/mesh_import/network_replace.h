#pragma once

#include "core/design/mesh_import/network_patch.h"

namespace rhombloom {

//! \brief \p whole with some of its parts replaced. \pre The parts have no triangle in common.
Plan replaced(const Trial& whole, const std::vector<Patch>& parts);

} // namespace rhombloom
