#pragma once

#include "core/building/build_history.h"
#include "core/building/viewpoints.h"

namespace rhombloom {

//! \brief Sum over the steps of the sides that wait to be hooked.
//! \details A side that is open in the \p last surface waits for nothing: else it would pay to close an opening with
//! elements that are cut only to be taken out again.
long exposure(const std::vector<Step>& steps, const Surface& last);

//! \brief Count what an order asks of the builder. View turns included (held_views).
Scorecard scorecard(const Replay& replay, const Element& element, const AssemblyPlan& plan);
Scorecard scorecard(const Replay& replay, const Element& element, const AssemblyPlan& plan, StageCoverage& coverage);

//! \brief What is wrong with a plan by the hard rules, one sentence each; empty = it can be built.
//! \details H1 every element but the first joins something; H2 it is one piece after every step; H3 the end is the
//! final surface; H4 only what is there and holds nothing together is removed; H5 components are built one after the
//! other; H6 no element with four neighbours is plugged in at a vertex of negative defect while its hole had an easier
//! one; H7 the open sides left are the final surface's boundary.
std::vector<std::string> plan_problems(const Replay& replay, const Element& element, const AssemblyPlan& plan);

} // namespace rhombloom
