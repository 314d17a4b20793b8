#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief How many pairs of elements of an embedded network cross each other.
int crossings(const Surface& surface);

} // namespace rhombloom
