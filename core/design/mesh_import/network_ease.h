#pragma once

#include "core/design/mesh_import/network_trial.h"

namespace rhombloom {

//! \brief Change the network of \p best around its most stretched elements until it can be built, as far as
//! \p work iterations times elements of small patches go. Returns what is left of that.
//! \details Changes are tried in patches, and the whole is settled after those that promise most. The best of these is
//! taken if it scores better; if none does, the next change is tried in the best of them, as far as a few changes go.
long ease(Trial& best, const Trials& trials, double price, long work);

} // namespace rhombloom
