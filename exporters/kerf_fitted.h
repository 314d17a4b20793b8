#pragma once

#include <vector>

#include "core/expected.h"
#include "exporters/kerf_curves.h"
#include "exporters/segment.h"

namespace rhombloom {

//! How short the segments that stand for a dense outline may be.
enum class ShortSegments
{
    Kept,   //!< as short as the outline's corners are
    Bridged //!< none under #shortest_segment where a chord can do without, which cuts corners off
};

//! \brief Lines and arcs (at most half circles) through some of the \p points of a closed outline, the others within
//! \p tolerance (mm) of them; chords that do without short segments stray further, by less than half their length.
std::vector<Segment> fitted_segments(const std::vector<Vec2>& points, double tolerance, ShortSegments how);

//! \brief The loops that the centre of an elliptic tool follows round a contour: dense polygons, from Clipper's offset
//! by a disc of the contour stretched until the ellipse is one.
//! \details For tools much longer than they are wide, whose offset curves are too sharp to be cut off where they cross.
//! Counter-clockwise contours grow, clockwise ones shrink and stay clockwise.
std::vector<std::vector<Vec2>> dense_offset(const std::vector<Segment>& contour, const Tool& tool);

} // namespace rhombloom
