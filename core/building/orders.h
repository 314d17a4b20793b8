#pragma once

#include "core/building/build_state.h"
#include "core/building/scorecard.h"

namespace rhombloom {

//! What every order is made from.
struct PlanSources
{
    const Replay& replay;
    const Element& element;
    const BuildHistory& history;
    StageCoverage& coverage;
    int last = -1; //!< the element to put in last (best order), a face of the final surface; -1: any
};

//! \brief The paper's order: first modelled, first built; each component spirals through its layers; every closed
//! shape is closed and reopened where the next component joins (Sec. 5).
std::vector<Step> paper_order(const PlanSources& sources);

//! \brief Elements of a target that are built in one go: of one component and connected.
std::vector<std::vector<int>> batches(const BuildState& state, const BuildHistory& history, const Target& target);

//! \brief The batch to build next: the first that touches what is there and whose component can be finished in one go;
//! else the first that touches; the first of all when nothing does.
std::size_t next_batch(const BuildState& state, const BuildHistory& history, const Target& target,
                       const std::vector<std::vector<int>>& waiting);

//! \brief The component whose chapter the change to \p target belongs to.
int chapter_of(const BuildState& state, const BuildHistory& history, const Target& target);

//! \brief What the builder likes; see best_order.
struct Taste
{
    double view = 1;     //!< elements that the current view shows
    double last = 0.3;   //!< elements beside the last one
    double dangling = 1; //!< not hanging by one side only
    double age = 0.2;    //!< closing the oldest rims first
};

//! \brief Where a later target takes elements away: a hole that can be left open from the start, or closed and
//! reopened.
struct Holes
{
    int count = 0;
    std::vector<int> of; //!< by element: the hole it closes for a time; -1: it stays
};

Holes holes(const BuildHistory& history);

//! \brief The targets of the history with all holes open that are not \p closed (by hole).
//! \details Where that tears a target into pieces, the one that goes on from what is built is kept; the others wait
//! until a later component joins them.
//! \param last left out of all but one more target at the end; -1: none
std::vector<Target> open_targets(const BuildHistory& history, const Holes& holes, const std::vector<char>& closed,
                                 int last);

//! \brief Greedy order: most built neighbours first, in the view that is held, beside the last element.
std::vector<Step> greedy_order(const PlanSources& sources, const std::vector<Target>& targets, const Taste& taste);

//! \brief The best plan found: several tastes and choices of what to close, scored (see the source).
//! \details Without steps when a last element is asked for and no order ends with it that obeys the hard rules and has
//! at most 1.05 of the exposure of the paper's order.
AssemblyPlan best_plan(const PlanSources& sources);

//! \brief A plan of these steps, with the temporary elements it uses renumbered without gaps, and its scorecard.
AssemblyPlan finish_plan(const PlanSources& sources, std::vector<Step> steps, Order order);

} // namespace rhombloom
