#pragma once

#include "core/design/mesh_import/network_trial.h"

namespace rhombloom {

//! \brief A small change of a plan.
struct Move
{
    enum class Kind
    {
        Flip,     //!< the element connects the two other corners of its triangles
        Split,    //!< a new corner in the middle of the element: three elements more
        Collapse, //!< the element's corners become one in their middle: three elements fewer
        Turn,     //!< the element is turned over
        Pop       //!< a node goes through to the other side of its neighbours; the network stays as it is
    };
    Kind kind = Kind::Flip;
    Corners corners; //!< of the element; of a pop: the vertex of the join, twice
};

struct MoveLimits
{
    int max_degree = 7;
    bool may_split = true;
    bool may_collapse = true;
    bool may_pop = false;
};

//! \brief What may be changed in \p trial for its number of elements to stay near the one asked for.
MoveLimits move_limits(const Trial& trial, const Trials& trials);

//! \brief Is the number of elements of a changed network near the one asked for, or no farther from it than \p before?
bool keeps_count(const Trial& changed, const Trial& before, const Trials& trials);

//! \brief Changes around the element between two corners, the most promising first.
std::vector<Move> moves_near(const Plan& plan, const Corners& place, const MoveLimits& limits);

//! \brief The plan after \p moves, which do not touch each other. What cannot be done is left out.
Plan carry_out(const std::vector<Move>& moves, const Plan& plan);

} // namespace rhombloom
