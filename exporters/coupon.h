#pragma once

#include "exporters/cut_sheet.h"

namespace rhombloom {

//! \brief The strips to cut first, and how to read them.
struct Coupon
{
    Drawing drawing;
    std::vector<double> kerfs; //!< mm; the pair with n notches is drawn for the n-th
    std::string text;          //!< for the README: what to do, then lines "a. ..." that say how to read it
    std::string warning;       //!< empty when all pairs could be drawn
};

//! \brief Pairs of real joints, each drawn for another kerf, and a 50 mm square drawn for none.
//! \details A pair is the short side of an element with both its hooks, and the half of an element with a long side
//! to be hooked in. Notches in the straight edge count the pairs. The values lie round the kerf of the options, or
//! run from 0 to 0.4 mm when it is 0. Values at which the slit cannot be drawn, and pairs that the sheet does not
//! hold, are left out.
Expected<Coupon> coupon(const HookParameters& parameters, const CutOptions& options);

} // namespace rhombloom
