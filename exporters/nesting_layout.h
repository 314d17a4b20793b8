#pragma once

#include "exporters/nesting_fragment.h"

namespace rhombloom::nesting {

//! \brief The outline prepared for the search.
struct Piece
{
    Polygon hull;     //!< of the finished outline: what must stay inside the margins
    Polygon inflated; //!< by half the spacing: what must not overlap
    NoFit self;       //!< offsets at which a copy overlaps an equally turned one
    Grain grain = Grain::Any;
    Mirror mirror = Mirror::Never;
};

Piece piece_of(const Polygon& outline, const NestOptions& options);

//! \brief Angles to try for a pattern: those that lay one of its vectors along a side, then \p count even steps.
std::vector<double> angles_for(const Pattern& pattern, Grain grain, int count);

//! \brief Does one copy fit, in any allowed direction?
bool fits(const Piece& piece, const Room& room);

//! \brief As many copies in \p room as the search finds, not more than \p wanted.
std::vector<Placement> densest_layout(const Piece& piece, const Room& room, int wanted);

//! \brief \p count copies, fewer than \p full has, packed to the lower or the left side so that the offcut is largest.
std::vector<Placement> packed_layout(const Piece& piece, const Room& room, const std::vector<Placement>& full,
                                     int count);

} // namespace rhombloom::nesting
