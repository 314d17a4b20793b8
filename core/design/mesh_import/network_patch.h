#pragma once

#include "core/design/mesh_import/network_moves.h"

namespace rhombloom {

//! \brief A part of a network in which a change is tried while the rest is held: that costs the same in a network of
//! any size.
struct Patch
{
    //! The triangles of the part, in its own numbers; points where they settled, for elements of their own size.
    Plan plan;
    std::vector<int> triangles; //!< which these were in the whole
    double badness = 0;         //!< what its elements add to the score of the whole, to first order
    double stretch = 0;         //!< the largest well away from the rim
    Corners worst;              //!< the element with it
    int iterations = 0;         //!< that the last settling took
};

//! \brief The triangles within a few edges of the element between the corners \p place.
Patch patch_around(const Trial& whole, const Corners& place, const Trials& trials, double price);

//! \brief The patch after \p move, settled between what is held. Empty when that changes nothing, is no surface, does
//! not settle or has impermissible defects.
std::optional<Patch> changed(const Patch& patch, const Move& move, const Trial& whole, const Trials& trials,
                             double price);

} // namespace rhombloom
