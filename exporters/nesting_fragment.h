#pragma once

#include <vector>

#include "exporters/nesting.h"
#include "exporters/nesting_lattice.h"

namespace rhombloom::nesting {

//! \brief One copy of a repeated cell.
struct Member
{
    Orientation orientation;
    Vec2 offset = Vec2::Zero();
};

//! \brief A lattice with one or more copies per cell.
struct Pattern
{
    Lattice lattice;
    std::vector<Member> members = {Member{}};

    double area_per_copy() const { return lattice.cell() / static_cast<double>(members.size()); }
};

//! \brief The room inside the margins; its lower left corner is the origin.
struct Room
{
    double width = 0;
    double height = 0;
};

//! \brief How far a copy sticks out: bounds of \p outline in an orientation.
Box extents(const Polygon& outline, const Orientation& orientation);

//! \brief The most copies of \p pattern turned by \p angle that fit into \p room, over all shifts of the pattern.
//! \details Exact: some copy touches the left edge and some copy the lower edge, and all such pairs are tried.
//! \param outline   the convex hull of the finished outline
//! \param at_least  return nothing when fewer fit
std::vector<Placement> fragment(const Pattern& pattern, double angle, const Polygon& outline, const Room& room,
                                std::size_t at_least = 1);

} // namespace rhombloom::nesting
