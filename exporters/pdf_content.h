#pragma once

#include <string>

namespace rhombloom {

//! \brief Write \p value in decimal.
void add_integer(std::string& out, long long value);

//! \brief Write \p value into a PDF content stream, good to 1/1000 and as short as it can be: "12", "-.25"; then a
//! space.
void add_number(std::string& out, double value);

//! \brief Write a glyph's two bytes inside a PDF string, escaped where needed.
void add_glyph(std::string& out, unsigned id);

} // namespace rhombloom
