#pragma once

#include <vector>

#include "exporters/segment.h"

namespace rhombloom {

//! \brief The disc or ellipse that the tool cuts, by its half axes, mm.
struct Tool
{
    double x = 0;
    double y = 0;
};

bool is_round(const Tool& tool);

//! \brief The point of the tool's rim that lies farthest in the direction \p normal (a unit vector).
Vec2 rim_point(const Tool& tool, const Vec2& normal);

//! \brief The curves that the tool's centre follows along each segment of a contour and round its convex corners, in
//! order. At concave corners they are trimmed to each other; where a segment is narrower than the tool there is none.
std::vector<Segment> offset_curves(const std::vector<Segment>& contour, const Tool& tool);

} // namespace rhombloom
