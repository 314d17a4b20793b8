#pragma once

#include <string>
#include <vector>

namespace rhombloom {

//! \brief The characters of a UTF-8 text. \pre It is well-formed.
std::vector<char32_t> code_points(const std::string& utf8);

//! \brief Upper-case, at least four digits: "30E9".
std::string hexadecimal(char32_t c);

} // namespace rhombloom
