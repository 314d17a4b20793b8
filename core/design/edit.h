#pragma once

#include "core/design/symmetry.h"
#include "core/form/embedding.h"

namespace rhombloom {

//! \brief Take \p elements out (a lamp holder's opening, a cable, a bulb hatch). Not embedded.
//! \details Refuses when the surface would fall apart, vanish, or touch itself at a single vertex.
Expected<Grafted> open_elements(const Surface& surface, const std::vector<Face>& elements);

//! \brief Turn \p elements over. Not embedded. Refuses when a vertex would leave the permissible defects.
Expected<Surface> flip_elements(const Surface& surface, const Element& element, const std::vector<Face>& elements);

//! \brief The elements and all their images, each once, in order of number.
Expected<std::vector<Face>> with_images(const Surface& surface, const Element& element, const Symmetry& symmetry,
                                        const std::vector<Face>& elements);

} // namespace rhombloom
