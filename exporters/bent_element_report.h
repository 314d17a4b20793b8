#pragma once

#include "exporters/bent_element.h"

namespace rhombloom {

//! \brief How true the bent elements are: lengths against those of the flat sheet.
BendingReport measure_bending(const BentSurface& bent, const Surface& surface, const Element& element,
                              const HookParameters& hooks);

} // namespace rhombloom
