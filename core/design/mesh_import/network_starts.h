#pragma once

#include <vector>

#include "core/design/mesh_import/network_trial.h"

namespace rhombloom {

//! \brief The networks that a search begins with: those of several remeshings of the target that settle, each as it is
//! and with its curvature matched.
//! \details The later attempts remesh differently, for targets on which the first did not come to anything.
std::vector<Trial> starts(const Trials& trials, int attempt);

} // namespace rhombloom
