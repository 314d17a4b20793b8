#pragma once

#include <numbers>

namespace rhombloom {

inline constexpr double pi = std::numbers::pi;
inline constexpr double two_pi = 2 * std::numbers::pi;

constexpr double radians(double degrees)
{
    return degrees * pi / 180;
}

constexpr double degrees(double radians)
{
    return radians * 180 / pi;
}

} // namespace rhombloom
