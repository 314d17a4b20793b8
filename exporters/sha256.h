#pragma once

#include <string>

namespace rhombloom {

//! \brief SHA-256 of \p bytes as 64 lower-case hexadecimal digits.
std::string sha256(const std::string& bytes);

} // namespace rhombloom
