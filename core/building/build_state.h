#pragma once

#include "core/building/build_history.h"

namespace rhombloom {

//! \brief What lies on the table while a plan is made: the elements present, the sides hooked, the steps so far.
struct BuildState
{
    std::vector<char> present;    //!< by element number
    std::vector<Ports> hooked;    //!< by element number
    std::vector<int> inserted_at; //!< by element number: step of the last insertion, -1 before
    std::vector<Step> steps;
    int last = -1; //!< the element handled last
    int stage = 0; //!< the stage whose shape is on the table
};

BuildState empty_state(const BuildHistory& history);

//! \brief The connections that \p element has in \p target to elements present and that are not hooked yet.
std::vector<Join> missing_joins(const BuildState& state, const Target& target, int element);

void insert(BuildState& state, const BuildHistory& history, const Target& target, int element);

//! \brief Open what the next target does not have: unhook, remove (fewest neighbours first, never tearing the shape
//! in two), then hook what elements already present get (Sec. 5, closing and reopening).
//! \details Elements that would fall off are removed as well; the next target puts them back.
//! \param component the chapter in which these steps are told.
void reopen(BuildState& state, const Target& target, int component);

//! \brief Are the elements present one piece by the hooks closed, when \p leaving is taken out (-1: none is)?
bool holds_together(const BuildState& state, int leaving = -1);

//! \brief Number of sides of present elements that are not hooked.
int open_sides(const BuildState& state);

//! \brief Does inserting \p element leave each hole that remains a last element that is easy to plug?
//! \details A closing element with four neighbours must not touch a vertex of negative defect (hard rule H6). True
//! also when the hole has no such element to begin with.
bool leaves_easy_plugs(const BuildState& state, const Target& target, int element);

} // namespace rhombloom
