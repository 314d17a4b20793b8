#pragma once

#include <string>

#include "core/design/design.h"

namespace rhombloom {

//! \brief One sentence with the remedy when the network of \p import was left far from its target: more than 0.7 la
//! rms, in either direction. Empty otherwise, and when the distance is not known.
std::string distance_warning(const Import& import, const Element& element);

} // namespace rhombloom
