#pragma once

#include <vector>

#include "exporters/segment.h"

namespace rhombloom {

//! \brief The contour with chords, within 0.002 mm, instead of runs of lines shorter than #shortest_segment: curves
//! that another program has cut to pieces.
std::vector<Segment> simplified_short_runs(const std::vector<Segment>& contour);

//! \brief The loop without segments shorter than #shortest_segment: neighbours are extended to meet, or brought
//! together in the middle of the short one.
std::vector<Segment> merged_short_segments(std::vector<Segment> loop);

} // namespace rhombloom
