#pragma once

#include "core/form/minimise.h"

namespace rhombloom {

//! \brief Newton's method on the few vertices that are out of equilibrium and those around them, all others held.
//! \details After a local edit of a shape in equilibrium this costs what the edit costs, and often all that is needed:
//! then the result is Converged for the whole. Stalled: too much is out of equilibrium, or the edit reaches farther.
MinimiseResult local_newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options);

//! \brief Newton's method on the vertices that \p is_free, all others held.
MinimiseResult newton_on(const std::vector<bool>& is_free, const EmbeddingTerms& terms, Iterate& iterate,
                         const MinimiseOptions& options);

} // namespace rhombloom
