#pragma once

#include "core/design/history.h"

namespace rhombloom {

enum class StepKind
{
    Insert,
    Remove,
    Unhook,
    Hook
};

//! \brief One connection made or undone: side \c side of the step's element and side \c to_side of element \c to.
struct Join
{
    int to = 0;
    int side = 0; //!< 0..3, side k runs from corner k to corner k + 1
    int to_side = 0;
};

struct Step
{
    StepKind kind = StepKind::Insert;
    int element = 0;         //!< face number in the final surface; temporary elements are numbered after the last
    std::vector<Join> joins; //!< the connections made (insert, hook) or undone (remove, unhook)
    int component = 0;       //!< index into Surface::components of the final surface
    int stage = 0;           //!< index into Replay::stages: the surface in which the step is drawn
};

//! An element that is built and taken out again: it exists in \c stage only as face \c face.
struct TemporaryElement
{
    int element = 0;
    int stage = 0;
    int face = 0;
};

struct Scorecard
{
    int steps = 0;
    int inserts = 0;
    int removals = 0;     //!< reopened elements
    int parts_needed = 0; //!< most elements present at once
    long exposure = 0;    //!< sum over the steps of the sides that wait to be hooked
    int one_neighbour_inserts = 0;
    int four_at_once_inserts = 0;
    int negative_defect_inserts = 0; //!< inserts with >= 3 built neighbours at a vertex of negative defect
    int view_turns = 0;              //!< filled in by the booklet's camera
    double minutes = 0;              //!< estimated building time
};

enum class Order
{
    Paper,
    Best
};

struct AssemblyPlan
{
    Order order = Order::Best;
    std::vector<Step> steps;
    std::vector<TemporaryElement> temporary;
    Scorecard scorecard;
};

//! \brief In what order the surface is built by hand (Sec. 5).
AssemblyPlan assembly_plan(const Replay& replay, const Element& element, Order order);

} // namespace rhombloom
