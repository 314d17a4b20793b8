#pragma once

#include "core/building/assembly_plan.h"

namespace rhombloom {

//! \brief The elements that can be the last one when the design names a bulb hatch: those beside the opening whose
//! purpose has the word "hatch", as faces of the final surface, the easiest to unhook first.
//! \details One that must be kept to hold the others together is none. Of several such openings the last one counts.
std::vector<int> hatch_elements(const Design& design, const Replay& replay, const Element& element);

//! \brief The assembly plan of a design: assembly_plan, but where the design names a bulb hatch the best order puts the
//! element beside that opening in last. Until then the hand finds room there, and later it is unhooked to widen it.
//! Only where waiting for it would keep too much open (see best_plan) the order is free.
AssemblyPlan design_plan(const Design& design, const Replay& replay, const Element& element, Order order);

} // namespace rhombloom
