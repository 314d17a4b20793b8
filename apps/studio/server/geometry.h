#pragma once

#include <nlohmann/json.hpp>

#include "core/model/element.h"
#include "core/model/surface.h"

namespace rhombloom::studio {

//! \brief Surfaces as the page draws them: a JSON header and arrays.
//! \details 4 bytes with the header's length (little endian), the header filled up with spaces to a multiple of 4, then
//! one after the other, V vertices and F elements in all: float32 positions (3 V, mm), float32 angular defects (V,
//! degrees, NaN on openings), float32 strains (F, see element_stretch()), int32 quads
//! (4 F, counter-clockwise from outside), int32 first corners (F, which corner of the quad is the piece's v0), int32
//! facing (F, 1 flipped), int32 components (F), int32 parts (F), int32 openings (V, 1 on a boundary). The header gets
//! "vertices", "elements" and "components".
std::string geometry_bytes(const std::vector<const Surface*>& parts, const Element& element,
                           nlohmann::ordered_json header);

} // namespace rhombloom::studio
