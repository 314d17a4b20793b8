#pragma once

#include <string_view>
#include <vector>

#include "exporters/drawing.h"

namespace rhombloom {

//! A loose piece can be read upside down: then 6 and 9 need a line under them.
enum class SixNine
{
    Plain,
    Underlined
};

//! \brief Text as single strokes for engraving and drawing: open paths of lines and arcs, each stroke once.
//! \details Knows the digits, the capital letters, and "/ . - : % + x ="; anything else is a gap.
//! \return Strokes whose base line starts in the origin; \p height is that of the capitals, mm.
std::vector<Path> strokes(std::string_view text, double height, SixNine six_nine = SixNine::Plain);

//! \brief Width of strokes(text, height), mm; 0 for no text.
double strokes_width(std::string_view text, double height);

} // namespace rhombloom
