#pragma once

#include "core/building/assembly_plan.h"

namespace rhombloom {

//! \brief Does the purpose of an opening have the word "hatch"?
bool names_hatch(std::string purpose);

//! \brief An opening of the final surface that the design made on purpose.
struct NamedOpening
{
    std::string purpose;        //!< as in the design: "lamp holder"
    std::vector<int> beside;    //!< the elements round it, as faces of the final surface, ascending
    Vec3 middle = Vec3::Zero(); //!< of those elements, mm
};

//! \brief The openings with a purpose, in the order of the operations; one operation with images makes several.
//! \details An opening that later operations have closed again, or built over, is left out.
std::vector<NamedOpening> named_openings(const Design& design, const Replay& replay);

//! \brief The elements that can be the last one when the design names a bulb hatch: those beside the opening whose
//! purpose has the word "hatch", as faces of the final surface, the easiest to unhook first.
//! \details One that must be kept to hold the others together is none. Of several such openings the last one counts.
std::vector<int> hatch_elements(const Design& design, const Replay& replay, const Element& element);

//! \brief The assembly plan of a design: assembly_plan, but where the design names a bulb hatch the best order puts the
//! element beside that opening in last. Until then the hand finds room there, and later it is unhooked to widen it.
//! Only where waiting for it would keep too much open (see best_plan) the order is free.
AssemblyPlan design_plan(const Design& design, const Replay& replay, const Element& element, Order order);

} // namespace rhombloom
