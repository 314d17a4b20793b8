#include "exporters/words.h"

#include <cmath>

#include "core/text.h"

namespace rhombloom {

std::string plural(long count, const std::string& noun)
{
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string duration(double minutes, int step)
{
    const double rounded = std::ceil(minutes / step) * step;
    return "about " + (rounded < 90 ? plural(static_cast<long>(rounded), "minute")
                                    : to_fixed(std::round(rounded / 30) / 2, 1) + " hours");
}

} // namespace rhombloom
