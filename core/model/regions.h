#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief The faces in regions that hang together by shared sides, without those that are \p left_out (by number;
//! empty: none is). \details Each begins with its lowest face, followed by the others from near to far; the regions are
//! in the order of their lowest faces.
std::vector<std::vector<Face>> connected_regions(const Surface& surface, std::vector<char> left_out = {});

} // namespace rhombloom
