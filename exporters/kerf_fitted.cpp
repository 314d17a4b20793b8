#include "exporters/kerf_fitted.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <polyclipping/clipper.hpp>

#include "exporters/kerf.h"

namespace rhombloom {

namespace {

using Points = std::vector<Vec2>;

constexpr double units = 1e7;          // of Clipper's grid, a mm
constexpr double flattening = 0.00002; // mm between arcs and their chords

//! Points i to j of a closed outline, counted on beyond the end.
const Vec2& cyclic(const Points& points, std::size_t i)
{
    return points[i % points.size()];
}

//! The points between and the middles of the edges: an arc through two ends of a long edge bulges there.
bool stays_near(const Points& points, std::size_t i, std::size_t j, const Segment& segment, double tolerance)
{
    for (std::size_t k = i; k < j; ++k) {
        const Vec2 &p = cyclic(points, k), &next = cyclic(points, k + 1);
        if (distance(segment, p) > tolerance || distance(segment, 0.5 * (p + next)) > tolerance) {
            return false;
        }
    }
    return true;
}

//! The arc through three points, as far as it is no more than half a circle.
std::optional<Segment> arc_through(const Vec2& a, const Vec2& middle, const Vec2& b)
{
    const Vec2 u = middle - a, v = b - middle;
    const double half = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)); // half of the included angle
    const double bulge = std::tan(half / 2);
    return std::abs(bulge) <= 1 ? std::optional(Segment{a, b, bulge}) : std::nullopt;
}

std::optional<Segment> fit(const Points& points, std::size_t i, std::size_t j, double tolerance)
{
    const Vec2 &a = cyclic(points, i), &b = cyclic(points, j);
    const Segment line{a, b, 0};
    if ((b - a).norm() < 1e-9) {
        return std::nullopt;
    }
    if (stays_near(points, i, j, line, tolerance)) {
        return line;
    }
    const auto arc = arc_through(a, cyclic(points, (i + j) / 2), b);
    return arc && stays_near(points, i, j, *arc, tolerance) ? arc : std::nullopt;
}

//! The last point up to which one segment from point \p i fits.
std::size_t farthest(const Points& points, std::size_t i, std::size_t end, double tolerance)
{
    std::size_t good = i + 1, step = 1;
    while (good + step <= end && fit(points, i, good + step, tolerance)) {
        good += step;
        step *= 2;
    }
    for (; step > 0; step /= 2) {
        while (good + step <= end && fit(points, i, good + step, tolerance)) {
            good += step;
        }
    }
    return good;
}

//! A straight stretch is the best place to begin: the longest edge.
std::size_t start_of(const Points& points)
{
    std::size_t best = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double longest = (cyclic(points, best + 1) - points[best]).norm();
        best = (cyclic(points, i + 1) - points[i]).norm() > longest ? i : best;
    }
    return best;
}

ClipperLib::Path to_grid(const Points& points, const Vec2& stretch)
{
    ClipperLib::Path path;
    for (const Vec2& p : points) {
        path.emplace_back(std::llround(p.x() * stretch.x() * units), std::llround(p.y() * stretch.y() * units));
    }
    return path;
}

Points from_grid(const ClipperLib::Path& path, const Vec2& stretch)
{
    Points points;
    for (const ClipperLib::IntPoint& p : path) {
        points.emplace_back(static_cast<double>(p.X) / units / stretch.x(),
                            static_cast<double>(p.Y) / units / stretch.y());
    }
    return points;
}

} // namespace

std::vector<Segment> fitted_segments(const std::vector<Vec2>& points, double tolerance, ShortSegments how)
{
    std::vector<Segment> result;
    const std::size_t first = start_of(points), end = first + points.size();
    for (std::size_t i = first; i < end;) {
        std::size_t j = farthest(points, i, end, tolerance);
        Segment segment = fit(points, i, j, tolerance).value_or(Segment{cyclic(points, i), cyclic(points, j), 0});
        if (how == ShortSegments::Bridged && length(segment) < shortest_segment) {
            while (j < end && (cyclic(points, j) - cyclic(points, i)).norm() < 1.1 * shortest_segment) {
                ++j;
            }
            segment = {cyclic(points, i), cyclic(points, j), 0};
        }
        result.push_back(segment);
        i = j;
    }
    return result;
}

std::vector<std::vector<Vec2>> dense_offset(const std::vector<Segment>& contour, const Tool& tool)
{
    const double radius = std::max(tool.x, tool.y);
    const Vec2 stretch(radius / tool.x, radius / tool.y);
    ClipperLib::Path path = to_grid(flatten(closed_path(contour), flattening), stretch);
    const bool hole = !ClipperLib::Orientation(path);
    if (hole) {
        ClipperLib::ReversePath(path);
    }
    ClipperLib::ClipperOffset offset(2, flattening * units);
    offset.AddPath(path, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
    ClipperLib::Paths loops;
    offset.Execute(loops, (hole ? -radius : radius) * units);
    std::vector<Points> result;
    for (ClipperLib::Path& loop : loops) {
        if (hole) {
            ClipperLib::ReversePath(loop);
        }
        result.push_back(from_grid(loop, stretch));
    }
    return result;
}

} // namespace rhombloom
