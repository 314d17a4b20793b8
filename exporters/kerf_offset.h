#pragma once

#include "exporters/kerf.h"
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

//! \brief Distance from the segments to \p p in units of the tool: 1 when a tool centred at p just touches
//! them; above 3 it may be any larger number.
double tool_distance(const Tool& tool, const std::vector<Segment>& contour, const Vec2& p);

//! \brief The closed loops of the boundary of the Minkowski sum of the tool and the material left of \p contour, in the
//! contour's sense; more than one when a gap closes. Refuses a contour whose pieces do not join.
Expected<std::vector<std::vector<Segment>>> offset_loops(const std::vector<Segment>& contour, const Tool& tool);

//! \brief The contour with chords, within 0.002 mm, instead of runs of lines shorter than #shortest_segment: curves
//! that another program has cut to pieces.
std::vector<Segment> simplified_short_runs(const std::vector<Segment>& contour);

//! \brief The loop without segments shorter than #shortest_segment: neighbours are extended to meet, or brought
//! together in the middle of the short one.
std::vector<Segment> merged_short_segments(std::vector<Segment> loop);

} // namespace rhombloom
