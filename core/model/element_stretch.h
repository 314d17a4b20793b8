#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! What a sheet gives; stretched further, hooks jump out or the sheet tears.
inline constexpr double usual_stretch_limit = 0.01;

//! \brief The largest (l - L) / L of an element's sides and diagonals, as EmbedReport::max_stretch is of a surface.
//! \details Compression does not count: every long side is joined to a short one and bows, 9 % shorter with lb = 1.1
//! la.
double element_stretch(const Surface& surface, const Element& element, Face f);

//! \brief The largest (L - l) / L of an element's sides and diagonals: how far it is bent or folded.
double element_compression(const Surface& surface, const Element& element, Face f);

} // namespace rhombloom
