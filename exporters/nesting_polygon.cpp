#include "exporters/nesting_polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/text.h"
#include "core/units.h"
#include "exporters/nesting_union.h"

namespace rhombloom::nesting {

namespace {

std::string text_of(const Vec2& p)
{
    return "(" + to_fixed(p.x(), 4) + ", " + to_fixed(p.y(), 4) + ")";
}

int side_of(const Vec2& a, const Vec2& b, const Vec2& p)
{
    const double area = cross_2d(b - a, p - a);
    return (area > 0) - (area < 0);
}

bool within_box(const Vec2& a, const Vec2& b, const Vec2& p)
{
    return (p.array() >= a.cwiseMin(b).array()).all() && (p.array() <= a.cwiseMax(b).array()).all();
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const int abc = side_of(a, b, c), abd = side_of(a, b, d), cda = side_of(c, d, a), cdb = side_of(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0) {
        return true;
    }
    return (abc == 0 && within_box(a, b, c)) || (abd == 0 && within_box(a, b, d)) ||
           (cda == 0 && within_box(c, d, a)) || (cdb == 0 && within_box(c, d, b));
}

//! Edges i and i + 1 share a point by right; they clash only when the second runs back over the first.
bool runs_back(const Vec2& a, const Vec2& b, const Vec2& c)
{
    return cross_2d(b - a, c - b) == 0 && (b - a).dot(c - b) < 0;
}

bool edges_clash(const Polygon& polygon, std::size_t i, std::size_t j)
{
    const std::size_t n = polygon.size();
    const std::size_t i1 = (i + 1) % n, j1 = (j + 1) % n;
    if (i1 == j) {
        return runs_back(polygon[i], polygon[j], polygon[j1]);
    }
    if (j1 == i) {
        return runs_back(polygon[j], polygon[i], polygon[i1]);
    }
    return segments_meet(polygon[i], polygon[i1], polygon[j], polygon[j1]);
}

//! Sweep in x: only edges whose spans in x overlap are compared.
Expected<void> check_crossings(const Polygon& polygon)
{
    const std::size_t n = polygon.size();
    const auto low = [&](std::size_t i) { return std::min(polygon[i].x(), polygon[(i + 1) % n].x()); };
    const auto high = [&](std::size_t i) { return std::max(polygon[i].x(), polygon[(i + 1) % n].x()); };
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
    std::vector<std::size_t> open;
    for (const std::size_t i : order) {
        std::erase_if(open, [&](std::size_t j) { return high(j) < low(i); });
        for (const std::size_t j : open) {
            if (edges_clash(polygon, i, j)) {
                return refuse("the outline crosses or touches itself near " + text_of(polygon[std::max(i, j)]) +
                              "; give one simple closed contour");
            }
        }
        open.push_back(i);
    }
    return {};
}

//! The rounded corner at \p p between two edge normals, as a chain of tangents to the circle.
void add_corner(Polygon& ring, const Vec2& p, const Vec2& normal, double sweep, double radius, double slack)
{
    const double widest = 2 * std::acos(radius / (radius + slack));
    const int steps = std::max(1, static_cast<int>(std::ceil(sweep / widest)));
    const double step = sweep / steps;
    for (int i = 0; i < steps; ++i) {
        ring.push_back(p + turn((i + 0.5) * step) * normal * (radius / std::cos(step / 2)));
    }
}

} // namespace

Turn turn(double angle)
{
    const double quarters = angle / (pi / 2);
    const double nearest = std::round(quarters);
    if (std::abs(quarters - nearest) < 1e-14 * std::max(1.0, std::abs(quarters))) {
        const int k = static_cast<int>(std::lround(nearest)) & 3;
        return {k == 0 ? 1.0 : k == 2 ? -1.0 : 0.0, k == 1 ? 1.0 : k == 3 ? -1.0 : 0.0};
    }
    return {std::cos(angle), std::sin(angle)};
}

Polygon oriented(const Polygon& polygon, const Orientation& orientation)
{
    Polygon result;
    result.reserve(polygon.size());
    const Turn t = turn(orientation.angle);
    for (const Vec2& p : polygon) {
        result.push_back(t * (orientation.mirrored ? Vec2(-p.x(), p.y()) : p));
    }
    if (orientation.mirrored) {
        std::reverse(result.begin(), result.end());
    }
    return result;
}

double signed_area(const Polygon& polygon)
{
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        sum += 0.5 * cross_2d(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    }
    return sum;
}

Box box_of(const Polygon& polygon)
{
    Box box;
    for (const Vec2& p : polygon) {
        box.min = box.min.cwiseMin(p);
        box.max = box.max.cwiseMax(p);
    }
    return box;
}

Polygon convex_hull(Polygon points)
{
    std::sort(points.begin(), points.end(),
              [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
    Polygon hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const Vec2& p : points) {
            while (hull.size() >= start + 2 && cross_2d(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) {
                hull.pop_back();
            }
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

std::vector<Vec2> long_edges(const Polygon& polygon, std::size_t count)
{
    std::vector<Vec2> edges;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        edges.push_back(polygon[(i + 1) % polygon.size()] - polygon[i]);
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const Vec2& a, const Vec2& b) { return a.squaredNorm() > b.squaredNorm(); });
    edges.resize(std::min(edges.size(), count));
    return edges;
}

Expected<void> check_simple(const Polygon& polygon)
{
    if (polygon.size() < 3) {
        return refuse("the outline has " + std::to_string(polygon.size()) + " points; a contour needs at least three");
    }
    for (const Vec2& p : polygon) {
        if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e6) {
            return refuse("the outline has a point that is not finite or beyond 1 km; coordinates are millimetres");
        }
    }
    const Box box = box_of(polygon);
    constexpr double least_size = 0.01;
    if ((box.max - box.min).maxCoeff() < least_size) {
        return refuse("the outline is less than 0.01 mm wide and high: coordinates are millimetres");
    }
    const double least_area = 1e-9 * (box.max - box.min).squaredNorm();
    const Polygon hull = convex_hull(polygon);
    if (hull.size() < 3 || signed_area(hull) <= least_area) {
        return refuse("the outline encloses no area: all its points lie in a line");
    }
    if (auto ok = check_crossings(polygon); !ok) {
        return ok;
    }
    return std::abs(signed_area(polygon)) > least_area ? Expected<void>{} : refuse("the outline encloses no area");
}

bool boundaries_meet(const Polygon& a, const Polygon& b)
{
    const Box box_a = box_of(a), box_b = box_of(b);
    const Vec2 low = box_a.min.cwiseMax(box_b.min), high = box_a.max.cwiseMin(box_b.max);
    const auto near = [&](const Vec2& p, const Vec2& q) {
        return (p.cwiseMax(q).array() >= low.array()).all() && (p.cwiseMin(q).array() <= high.array()).all();
    };
    for (std::size_t i = 0, h = a.size() - 1; i < a.size(); h = i++) {
        if (!near(a[h], a[i])) {
            continue;
        }
        for (std::size_t j = 0, k = b.size() - 1; j < b.size(); k = j++) {
            if (near(b[k], b[j]) && segments_meet(a[h], a[i], b[k], b[j])) {
                return true;
            }
        }
    }
    return false;
}

Polygon inflated(const Polygon& polygon, double radius, double slack)
{
    if (radius <= 0) {
        return polygon;
    }
    Polygon ring;
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 in = (polygon[i] - polygon[(i + n - 1) % n]).normalized();
        const Vec2 out = (polygon[(i + 1) % n] - polygon[i]).normalized();
        const Vec2 normal(in.y(), -in.x());
        const double sweep = std::atan2(cross_2d(in, out), in.dot(out));
        if (sweep > 0) {
            add_corner(ring, polygon[i], normal, sweep, radius, slack);
        } else {
            ring.push_back(polygon[i] + radius * normal);
            ring.push_back(polygon[i]);
            ring.push_back(polygon[i] + radius * Vec2(out.y(), -out.x()));
        }
    }
    return outer_contour(ring);
}

} // namespace rhombloom::nesting
