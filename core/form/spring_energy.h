#pragma once

namespace rhombloom {

//! \brief How the springs answer to their length (DESIGN.md section 3). Lengths in units of la.
struct SpringLaw
{
    double compressed_weight = 1;  //!< k for l <= L
    double stretched_weight = 100; //!< k for l > L: an element hardly stretches
    double barrier_weight = 100;   //!< added below barrier_ratio * L
    double barrier_ratio = 0;      //!< no valid shape is pressed together that far; see barrier_ratio()
};

//! \brief The length, as a share of the rest length, below which the barrier acts: min(0.75, 0.9 la / lb).
//! \details The paper's springs let elements of mixed facing collapse to a line. In an equilibrium both half-edges of
//! an edge end near la, so a long one is compressed to about la / lb and the barrier has to start below that.
double barrier_ratio(double la, double lb);

//! \brief Energy of one spring, and its first and second derivative by the length.
struct SpringResponse
{
    double energy = 0;    //!< without the barrier
    double barrier = 0;   //!< zero on valid shapes
    double force = 0;     //!< of both
    double stiffness = 0; //!< of both
};

//! \brief `k/L (l - L)^2`, plus the barrier, for a spring of rest length \p rest at length \p length.
SpringResponse spring_response(const SpringLaw& law, double rest, double length);

} // namespace rhombloom
