#pragma once

#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/units.h"
#include "exporters/nesting.h"

//! Outlines that the tests and the benchmark of the nesting share; mm.
namespace rhombloom::outlines {

using Outline = std::vector<Vec2>;

inline Outline from_data(const std::string& name)
{
    std::ifstream file(RHOMBLOOM_SOURCE_DIR "/tests/data/" + name);
    const auto json = nlohmann::json::parse(file);
    Outline outline;
    for (const auto& p : json.at("outline")) {
        outline.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
    }
    return outline;
}

inline Outline rectangle(double width, double height)
{
    return {{0, 0}, {width, 0}, {width, height}, {0, height}};
}

inline Outline l_shape()
{
    return {{0, 0}, {70, 0}, {70, 22}, {22, 22}, {22, 60}, {0, 60}};
}

inline Outline triangle()
{
    return {{0, 0}, {80, 0}, {25, 65}};
}

inline Outline arrow()
{
    return {{0, 18}, {45, 18}, {45, 0}, {85, 30}, {45, 60}, {45, 42}, {0, 42}, {12, 30}};
}

inline Outline tee()
{
    return {{0, 0}, {70, 0}, {70, 18}, {44, 18}, {44, 65}, {26, 65}, {26, 18}, {0, 18}};
}

inline Outline u_shape()
{
    return {{0, 0}, {60, 0}, {60, 55}, {42, 55}, {42, 18}, {18, 18}, {18, 55}, {0, 55}};
}

inline Outline star(int tips, double outer, double inner)
{
    Outline outline;
    for (int i = 0; i < 2 * tips; ++i) {
        const double r = i % 2 == 0 ? outer : inner, a = pi / 2 + pi * i / tips;
        outline.emplace_back(r * std::cos(a), r * std::sin(a));
    }
    return outline;
}

inline Outline regular(int corners, double radius)
{
    return star(corners, radius, radius * std::cos(pi / corners));
}

//! A half moon: thousands of points when \p points is.
inline Outline crescent(int points)
{
    Outline outline;
    for (int i = 0; i < points; ++i) {
        const double a = -pi / 2 + pi * i / points;
        outline.emplace_back(40 * std::cos(a), 40 * std::sin(a));
    }
    for (int i = 0; i < points; ++i) {
        const double a = pi / 2 - pi * i / points;
        outline.emplace_back(18 * std::cos(a), 40 * std::sin(a));
    }
    return outline;
}

//! A star-shaped polygon with uneven radii from a small generator of its own (the same on every machine).
inline Outline random_concave(std::uint64_t seed, int corners = 0)
{
    const auto next = [&] {
        seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(seed >> 40) / static_cast<double>(1 << 24);
    };
    next();
    const int n = corners > 0 ? corners : 5 + static_cast<int>(9 * next());
    const double stretch = 0.6 + 0.8 * next();
    Outline outline;
    for (int i = 0; i < n; ++i) {
        const double a = two_pi * (i + 0.7 * next()) / n, r = 12 + 38 * next();
        outline.emplace_back(stretch * r * std::cos(a), r * std::sin(a));
    }
    return outline;
}

} // namespace rhombloom::outlines
