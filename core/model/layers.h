#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief Layers of elements round vertex \p seed (Sec. 4.3): the first is its ring, the next all elements
//! edge-adjacent to the one before. Every face reachable from the seed is in exactly one layer.
std::vector<std::vector<Face>> layers(const Surface& surface, Vertex seed);

} // namespace rhombloom
