#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief Do elements of an embedded network cross each other?
bool has_crossings(const Surface& surface);

} // namespace rhombloom
