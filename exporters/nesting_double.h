#pragma once

#include <vector>

#include "exporters/nesting_fragment.h"

namespace rhombloom::nesting {

//! \brief A copy as drawn and a mate in another orientation, with the no-fit regions between them.
struct Mates
{
    Orientation mate;
    NoFit self;  //!< drawn with drawn
    NoFit other; //!< mate with mate
    NoFit cross; //!< offsets of the mate at which it overlaps the drawn one
};

Mates mates_of(const Polygon& inflated, const NoFit& self, const Orientation& mate);

//! \brief Dense lattices with two copies per cell, smallest cell first.
//! \details Rows of drawn copies alternate with rows of mates. The direction and pitch of the rows are sampled; for
//! each, the lowest stack of a row of mates and the next row of drawn copies is looked up on a grid of shifts from
//! three skylines; the best are refined by pattern search (cf. Kuperberg and Kuperberg 1990, Mount 1991 for convex
//! bodies). \param keep  patterns returned at most
std::vector<Pattern> double_patterns(const Mates& mates, int keep);

} // namespace rhombloom::nesting
