#pragma once

#include "core/expected.h"
#include "exporters/drawing.h"

namespace rhombloom {

//! \brief A straight cut: through a point, with the part to keep on its left.
struct CropLine
{
    Vec2 point = Vec2::Zero();
    Vec2 direction = Vec2::UnitX(); //!< of length 1
};

//! \brief The part of a simple closed counter-clockwise contour to the left of \p line, arcs kept as arcs.
//! \return A contour whose last segment is the cut edge. Refused when the line does not cross the contour exactly
//! twice: the part would not be one piece with one cut edge.
Expected<Path> cropped(const Path& contour, const CropLine& line);

//! \brief Cut \p count V notches, \p width wide and three quarters of that deep, into the middle of the last segment,
//! two widths apart. \pre The last segment is straight and long enough.
Path notched(const Path& contour, int count, double width);

} // namespace rhombloom
