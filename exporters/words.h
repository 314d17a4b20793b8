#pragma once

#include <string>

namespace rhombloom {

//! \brief "1 sheet", "2 sheets".
std::string plural(long count, const std::string& noun);

//! \brief "about 35 minutes", rounded up to \p step minutes; from 90 minutes on "about 2.5 hours".
std::string duration(double minutes, int step);

} // namespace rhombloom
