#pragma once

#include <array>
#include <vector>

#include "core/building/assembly_plan.h"

namespace rhombloom {

//! \brief Where a side leads: side \c side of element \c element; element -1 is an open side.
struct Port
{
    int element = -1;
    int side = -1;

    friend bool operator==(const Port&, const Port&) = default;
};

using Ports = std::array<Port, 4>;

//! \brief A connected shape that the history passes through: what is built, and perhaps closed, before the next one.
//! \details The vectors are indexed by element number (see BuildHistory).
struct Target
{
    int stage = 0;            //!< index into Replay::stages, whose embedding shows the shape
    std::vector<int> face;    //!< face of that stage's surface; -1: the element is no part of the target
    std::vector<Ports> ports; //!< the connections of the finished target
    std::vector<char> hard;   //!< the element touches a vertex of negative defect

    bool has(int element) const { return face[element] >= 0; }
};

//! \brief The construction history as a list of connected targets over one numbering of elements.
//! \details Elements of the final surface have their face number; those that only exist in between follow, in the
//! order in which the history makes them. A part that is placed but not yet joined to the rest is no target: its
//! elements are built when an operation joins them (sequential, not parallel assembly, Sec. 5).
struct BuildHistory
{
    int final_count = 0;                     //!< elements of the final surface
    std::vector<TemporaryElement> temporary; //!< in the order of their numbers, from final_count on
    std::vector<int> component;              //!< by element: index into the final surface's components
    std::vector<Target> targets;             //!< at least one; the last one is the final surface

    int element_count() const { return static_cast<int>(component.size()); }
};

//! \brief Derive the targets from the stages of a replay; elements are recognised by their serial.
//! \pre Every face of every stage has a serial >= 0, unique in its stage.
BuildHistory build_history(const Replay& replay, const Element& element);

//! \brief The surface in which a step with that stage is drawn. The last stage's is Replay::surface.
const Surface& stage_surface(const Replay& replay, int stage);

//! \brief Number of the last stage: the final surface's.
int last_stage(const Replay& replay);

//! \brief The face of each element in a stage, or -1, for the numbering of a plan.
std::vector<int> faces_of_elements(const Replay& replay, const AssemblyPlan& plan, int stage);

//! \brief Which elements a stage's pictures show: those that are there during one of its steps. By element number.
std::vector<char> shown_elements(const AssemblyPlan& plan, std::size_t final_count, int stage);

//! \brief The same target without some elements and without the connections \p keep refuses.
//! \details Used for shapes that are deliberately left open.
Target without(const Target& target, const std::vector<char>& left_out);

} // namespace rhombloom
