#pragma once

#include "core/form/minimise.h"
#include "core/form/newton_system.h"

namespace rhombloom {

//! \brief For where a large surface is nearly in equilibrium and its Hessian is indefinite: the minimum of the energy
//! with hinges that become stiff gradually, over a width of angles that is narrowed until the exact Hessian is positive
//! definite; then the result is Stalled.
//! \details In flat regions most hinges are within a few ten-thousandths of a radian of flat, and pushed edges are held
//! by those that happen to be concave. With a width, Newton's method converges quadratically; each minimum is near the
//! next one. Where the surface loses a symmetry on the way, the Hessian is indefinite for a few steps.
//! \param width radians, where to begin; 0: by the mean angle. Then the next one to try.
MinimiseResult smoothed_descent(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& iterate,
                                const MinimiseOptions& options, double& width);

} // namespace rhombloom
