#pragma once

#include "core/expected.h"
#include "exporters/kerf_curves.h"

namespace rhombloom {

//! \brief Distance from the segments to \p p in units of the tool: 1 when a tool centred at p just touches
//! them; above 3 it may be any larger number.
double tool_distance(const Tool& tool, const std::vector<Segment>& contour, const Vec2& p);

//! \brief The closed loops of the boundary of the Minkowski sum of the tool and the material left of \p contour, in the
//! contour's sense; more than one when a gap closes. Refuses a contour whose pieces do not join.
Expected<std::vector<std::vector<Segment>>> offset_loops(const std::vector<Segment>& contour, const Tool& tool);

} // namespace rhombloom
