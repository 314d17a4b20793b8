#pragma once

#include <string_view>

#include "core/model/surface.h"

namespace rhombloom {

//! \brief A surface of the library: generated, not stored (notes on combinatorics: DESIGN.md, hook notes 1.3).
struct BaseShape
{
    std::string name;    //!< e.g. "ball-30"
    std::string summary; //!< one line for `rhombloom shapes`
    Surface surface;     //!< the generator's positions, scaled so that the edges are about la long; not embedded
    Vertex seed;         //!< where layers start (Sec. 4.3)
};

//! \brief The shapes listed by `rhombloom shapes`, in that order.
std::vector<std::string> base_shape_names();

//! \brief Make a shape by name: "ball-30", "polar-5x4", "rhombic-12", "checker-120", "tube-6x4", "torus-12x24",
//! "dome-5x3", "sheet-4x6", ... Families take any number they can build.
//! \details An unknown name or an impossible number is refused with the nearest names or the range.
Expected<BaseShape> base_shape(std::string_view name, const Element& element);

} // namespace rhombloom
