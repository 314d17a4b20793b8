#include "exporters/nesting_union.h"

#include <cmath>

#include <polyclipping/clipper.hpp>

namespace rhombloom::nesting {

namespace {

ClipperLib::Path to_clipper(const Polygon& polygon)
{
    ClipperLib::Path path;
    path.reserve(polygon.size());
    for (const Vec2& p : polygon) {
        path.emplace_back(to_grid(p.x()), to_grid(p.y()));
    }
    return path;
}

Polygon from_clipper(const ClipperLib::Path& path)
{
    Polygon polygon;
    polygon.reserve(path.size());
    for (const ClipperLib::IntPoint& p : path) {
        polygon.emplace_back(static_cast<double>(p.X) / grid, static_cast<double>(p.Y) / grid);
    }
    return polygon;
}

std::vector<Polygon> clipped(const std::vector<Polygon>& subject, const std::vector<Polygon>& clip,
                             ClipperLib::ClipType type, ClipperLib::PolyFillType fill)
{
    ClipperLib::Clipper clipper;
    for (const Polygon& polygon : subject) {
        clipper.AddPath(to_clipper(polygon), ClipperLib::ptSubject, true);
    }
    for (const Polygon& polygon : clip) {
        clipper.AddPath(to_clipper(polygon), ClipperLib::ptClip, true);
    }
    ClipperLib::Paths paths;
    clipper.Execute(type, paths, fill, fill);
    std::vector<Polygon> result;
    for (const ClipperLib::Path& path : paths) {
        if (path.size() >= 3) {
            result.push_back(from_clipper(path));
        }
    }
    return result;
}

} // namespace

std::int64_t to_grid(double mm)
{
    return std::llround(mm * grid);
}

std::vector<Polygon> united(const std::vector<Polygon>& rings)
{
    return clipped(rings, {}, ClipperLib::ctUnion, ClipperLib::pftNonZero);
}

std::vector<Polygon> without(const std::vector<Polygon>& region, const std::vector<Polygon>& holes)
{
    return clipped(region, holes, ClipperLib::ctDifference, ClipperLib::pftNonZero);
}

Polygon outer_contour(const Polygon& ring)
{
    Polygon largest;
    for (Polygon& contour : clipped({ring}, {}, ClipperLib::ctUnion, ClipperLib::pftPositive)) {
        if (largest.empty() || signed_area(contour) > signed_area(largest)) {
            largest = std::move(contour);
        }
    }
    return largest;
}

} // namespace rhombloom::nesting
