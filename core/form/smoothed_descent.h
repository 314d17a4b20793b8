#pragma once

#include "core/form/minimise.h"
#include "core/form/newton_system.h"

namespace rhombloom {

//! \brief To the minimum of the energy with hinges that become stiff gradually, over a width of angles.
//! \details In flat regions of a large surface most hinges are within a few ten-thousandths of a radian of flat, and
//! pushed edges are held by those that happen to be concave. With a width, Newton's method converges quadratically.
//! Where the surface loses a symmetry on the way, the Hessian is indefinite for a few steps. The minima for all widths
//! are the central path of interior_descent(), whose products of slack and force are 2 weight width^2.
//! \param width radians.
//! \return false when it is time to stop, or no step leads down.
bool smoothed_descent(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& now, double width,
                      const MinimiseOptions& options, MinimiseResult& result);

} // namespace rhombloom
