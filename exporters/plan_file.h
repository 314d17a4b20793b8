#pragma once

#include "core/building/assembly_plan.h"
#include "exporters/booklet_layout.h"

namespace rhombloom {

//! \brief plan.json (DESIGN.md section 7): the steps with where and how the booklet draws them, the temporary elements,
//! the shapes in between and the scorecard. With surface.json alone another program can replay and check the plan.
//! \details `view` is a 3 x 4 matrix: times (x, y, z, 1) in mm it gives the point on the page in points from the lower
//! left corner, and the depth toward the eye. `shape` of a step is "final" (surface.json) or an index into `shapes`,
//! whose `elements` name the element of each face. `inset` is the magnified detail, with its own `view`, or null.
std::string plan_json(const Replay& replay, const Element& element, const AssemblyPlan& plan,
                      const BookletLayout& layout);

} // namespace rhombloom
