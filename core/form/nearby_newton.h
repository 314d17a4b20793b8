#pragma once

#include "core/form/minimise.h"

namespace rhombloom {

//! \brief Newton's method in short steps, for positions close to an equilibrium: it keeps the folds that are there,
//! where minimise() would look for a shape of less energy and may find one far away.
//! \details Converged, or Stalled when a few dozen iterations do not lead there.
MinimiseResult nearby_newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options);

} // namespace rhombloom
