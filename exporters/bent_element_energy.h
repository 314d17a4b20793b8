#pragma once

#include "exporters/bent_element_bend.h"

namespace rhombloom {

//! Where the seats belong, one column each: Rp from the node on the straight sides, mm.
using SeatPlaces = Eigen::Matrix<double, 8, 3>;

SeatPlaces seat_places(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners);

//! \brief The energy of a patch, mm2; its gradient by the inner controls goes to \p gradient.
double sheet_energy(const SheetMechanics& mechanics, const BentPatch& patch, const SeatPlaces& places,
                    SheetMechanics::Vector& gradient);

enum class Stress
{
    Ignored,
    Counted
};

//! \brief The energy's second derivative by the inner controls, or its Gauss-Newton part, which is never negative.
SheetMechanics::Matrix model_matrix(const SheetMechanics& mechanics, const BentPatch& patch, Stress stress);

//! \brief \p patch with its inner controls moved by \p step.
BentPatch stepped(const BentPatch& patch, const SheetMechanics::Vector& step);

Vec3 bilinear(const std::array<Vec3, 4>& corners, double u, double v);

//! \brief Minimise the energy by damped Newton from any start: for shapes where many others begin.
BentPatch bend_by_newton(const SheetMechanics& mechanics, BentPatch patch, const std::array<Vec3, 4>& corners);

} // namespace rhombloom
