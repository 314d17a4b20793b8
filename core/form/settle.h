#pragma once

#include "core/form/embedding.h"
#include "core/form/minimise.h"

namespace rhombloom {

struct Settled
{
    MinimiseResult result;
    int restarts = 0;
    bool guarded = false; //!< the barrier or the ridge bears load: without them this shape has no equilibrium nearby
};

//! \brief Bring \p x into equilibrium from any finite positions.
//! \details minimise() from the positions, if they are of any use; then, while that has not converged or has left a
//! dimple or a fold, from repaired ones (start_shape.h), at most five times. The lowest energy counts. Guards that bear
//! load in the end are taken away when the shape stands without them, unless they are to be kept. An edited equilibrium
//! is not repaired: the seam of two parts is sharply concave by design. A start that is far from equilibrium everywhere
//! leads to the lowest equilibrium that refilled folds, the connectivity alone (connectivity_start.h) and
//! lower_equilibrium() find.
Settled settle(EmbeddingTerms& terms, Eigen::VectorXd& x, const MinimiseOptions& options, Start start = Start::Unknown,
               bool keep_guards = false);

//! \brief Take the barrier and the ridge out of the energy.
void remove_guards(EmbeddingTerms& terms);

} // namespace rhombloom
