#pragma once

#include <string>

namespace rhombloom {

//! \brief Shortest decimal that reads back as \p value; never depends on the locale.
std::string to_text(double value);

//! \brief \p value rounded to \p decimals places, without trailing zeros and without "-0".
std::string to_fixed(double value, int decimals);

} // namespace rhombloom
