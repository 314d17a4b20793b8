#pragma once

#include <string>

namespace rhombloom {

//! \brief \p text as it may stand in XML or HTML, between tags or in double quotes; control characters become spaces.
std::string markup_escaped(const std::string& text);

} // namespace rhombloom
