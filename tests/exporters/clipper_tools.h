#pragma once

#include <cmath>

#include <polyclipping/clipper.hpp>

#include "exporters/drawing.h"

//! Measurements by a second geometry library.
namespace rhombloom::tests {

inline constexpr double units_per_mm = 1e7;

inline ClipperLib::Path to_clipper(const std::vector<Vec2>& points)
{
    ClipperLib::Path path;
    for (const Vec2& p : points) {
        path.emplace_back(std::llround(p.x() * units_per_mm), std::llround(p.y() * units_per_mm));
    }
    return path;
}

inline ClipperLib::Path to_clipper(const Path& path, double tolerance = 1e-6)
{
    return to_clipper(flatten(path, tolerance));
}

//! mm2; holes count negative.
inline double clipper_area(const ClipperLib::Paths& paths)
{
    double sum = 0;
    for (const auto& path : paths) {
        sum += ClipperLib::Area(path);
    }
    return sum / units_per_mm / units_per_mm;
}

inline ClipperLib::Paths clipper_offset(const ClipperLib::Paths& paths, double delta, double arc_tolerance = 1e-6)
{
    ClipperLib::ClipperOffset offset(2, arc_tolerance * units_per_mm);
    offset.AddPaths(paths, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
    ClipperLib::Paths result;
    offset.Execute(result, delta * units_per_mm);
    return result;
}

inline ClipperLib::Paths clipper_combine(ClipperLib::ClipType type, const ClipperLib::Paths& a,
                                         const ClipperLib::Paths& b)
{
    ClipperLib::Clipper clipper;
    clipper.AddPaths(a, ClipperLib::ptSubject, true);
    clipper.AddPaths(b, ClipperLib::ptClip, true);
    ClipperLib::Paths result;
    clipper.Execute(type, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    return result;
}

//! Area of what only one of both covers, mm2.
inline double difference_area(const ClipperLib::Paths& a, const ClipperLib::Paths& b)
{
    return clipper_area(clipper_combine(ClipperLib::ctXor, a, b));
}

} // namespace rhombloom::tests
