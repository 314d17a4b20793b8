#pragma once

#include "exporters/pdf_canvas.h"

namespace rhombloom {

//! \brief The points as they are written: to 1/16 point, 0.02 mm: such numbers pack well. Where a closed polygon would
//! lose a corner that way: as fine as cairo can write, and if need be with that corner moved aside by 1/64.
Polygon on_grid(const Polygon& points, bool closed);

} // namespace rhombloom
