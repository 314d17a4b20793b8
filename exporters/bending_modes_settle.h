#pragma once

#include "exporters/bending_modes.h"

namespace rhombloom {

struct SettleReport
{
    double max_shift_mm = 0;        //!< of a point by settling
    double max_corner_error_mm = 0; //!< of a corner to its vertex
    double max_rim_distortion = 0;  //!< |bent/flat - 1| of a whole outline
    double p99_before = 0;          //!< |bent/flat - 1| of segments, as the elements came
    double p99_after = 0;           //!< and settled
};

//! \brief Let the elements of \p bent settle in shapes that \p count bending modes describe exactly.
//! \details The modes are the principal ones of the elements as they come. Each element then finds the pose and the
//! weights with which its segments keep their flat lengths best, its outline the flat outline's, its corners their
//! vertices and its points their places (Gauss-Newton on count + 6 unknowns). Then all are drawn back to their flat
//! lengths and settle anew, a few rounds: the modes turn to shapes that keep lengths. Points and normals of \p bent are
//! replaced by the modes'; normals are then no longer of length 1, so that thickness too is linear in the weights.
BendingModes settle(BentSurface& bent, const Element& element, const HookParameters& hooks, int count,
                    SettleReport* report = nullptr);

} // namespace rhombloom
