#pragma once

#include "exporters/nesting_fragment.h"

namespace rhombloom::nesting {

using Layout = std::vector<Placement>;

//! \brief The outline prepared for the search, with the patterns it can be repeated in.
struct Piece
{
    Polygon hull;     //!< of the finished outline: what must stay inside the margins
    Polygon inflated; //!< by half the spacing: what must not overlap
    NoFit self;       //!< offsets at which a copy overlaps an equally turned one
    NoFit turned;     //!< offsets at which a copy turned by 180 degrees overlaps a drawn one
    double spacing = 0;
    Grain grain = Grain::Any;
    Mirror mirror = Mirror::Never;
    std::vector<Pattern> patterns; //!< densest first
};

Piece piece_of(const Polygon& outline, const NestOptions& options);

//! \brief A pattern at an angle.
struct Trial
{
    const Pattern* pattern = nullptr;
    double angle = 0;
    bool even = false; //!< one of even steps, not one that lays the pattern along a side
};

//! \brief What is worth trying in a room, most promising first; fewer trials when a sheet takes many copies.
std::vector<Trial> trials_for(const Piece& piece, const Room& room);

//! \brief The upper right corner of all copies' common bounds.
Vec2 upper_right(const Layout& layout, const Piece& piece);

//! \brief One copy in an allowed direction, or nothing when it fits in none.
Layout single_copy(const Piece& piece, const Room& room);

//! \brief As many copies in \p room as the search finds, at least one if one fits.
//! \param wanted  copies in all, on this sheet and the ones that follow
Layout densest_layout(const Piece& piece, const Room& room, int wanted, Effort effort);

//! \brief \p count copies, not more than \p full has, packed to the lower or the left side so that the offcut is large.
Layout packed_layout(const Piece& piece, const Room& room, const Layout& full, int count);

} // namespace rhombloom::nesting
