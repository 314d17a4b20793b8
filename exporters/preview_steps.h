#pragma once

#include "core/building/assembly_plan.h"
#include "exporters/bending_modes.h"

namespace rhombloom {

//! \brief What the page plays beyond the finished model.
struct PreviewSteps
{
    std::vector<Step> steps;
    std::vector<BentElement> temporary;         //!< built and taken out again, numbered after the last element
    std::vector<BentPose> temporary_poses;      //!< in the model's modes
    std::vector<std::array<int, 4>> neighbours; //!< of every element, side by side; -1: open
};

//! \brief The steps of \p plan with the shapes of its temporary elements.
//! \details Each is bent in the stage where it exists and then moved, rigidly, to where the elements round it stand in
//! the finished model: stages are embedded one by one and do not share a position.
Expected<PreviewSteps> preview_steps(const Replay& replay, const AssemblyPlan& plan, const Element& element,
                                     const HookParameters& hooks);

} // namespace rhombloom
