#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief Mean of the elements' centres, mm: they all weigh the same.
Vec3 mass_centre(const Surface& surface);

//! \brief Where cords are fixed so that the model hangs as it stands, z up.
//! \details The highest point above the centre of mass. Where nothing is above it (a tube, a ring, a bowl): up to three
//! vertices high up round the centre, a third of the way from each other.
std::vector<Vec3> hanging_points(const Surface& surface);

} // namespace rhombloom
