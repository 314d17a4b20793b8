#pragma once

#include <string_view>

#include "core/design/design.h"

namespace rhombloom {

//! \brief Read a design from JSON text (DESIGN.md section 4).
//! \details Errors name the JSON path, what stands there and what was expected: unknown or duplicate keys, wrong types,
//! NaN or absurd numbers, an unknown version, nesting deeper than a design can be.
Expected<Design> parse_design(std::string_view json);

//! \brief Write a design as JSON. parse_design(write_design(d)) gives d, and the text is the same every time.
std::string write_design(const Design& design);

//! \brief A title that a design may have, from the name of a file, which may be any bytes: well-formed, on one line, at
//! most 80 characters.
std::string title_of(const std::string& file_stem);

} // namespace rhombloom
