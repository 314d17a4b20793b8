#pragma once

#include "core/design/mesh_import/network_trial.h"

namespace rhombloom {

//! \brief Change the network of \p best around its most stretched elements until it can be built, as far as
//! \p work iterations times elements of small patches go.
//! \details Changes, and changes after changes, are tried in patches; the best are taken if the whole, settled, scores
//! better.
void ease(Trial& best, const Trials& trials, double price, long work);

} // namespace rhombloom
