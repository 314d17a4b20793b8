#include "exporters/nesting_no_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "exporters/nesting_union.h"

namespace rhombloom::nesting {

namespace {

__extension__ typedef __int128 Wide;

struct GridVector
{
    std::int64_t x = 0, y = 0;
    bool operator==(const GridVector&) const = default;
};

int sign(Wide v)
{
    return (v > 0) - (v < 0);
}

int turning(const GridVector& a, const GridVector& b)
{
    return sign(static_cast<Wide>(a.x) * b.y - static_cast<Wide>(a.y) * b.x);
}

//! A polygon on the grid with the directions of its edges; no edge has length zero.
struct Ring
{
    std::vector<GridVector> points;
    std::vector<GridVector> edges; //!< from point i to point i + 1
    std::vector<int> turns;        //!< at point i: 1 left, -1 right
    std::size_t size() const { return points.size(); }
};

Ring ring_of(const Polygon& polygon, double factor)
{
    Ring ring;
    for (const Vec2& p : polygon) {
        const GridVector g{to_grid(factor * p.x()), to_grid(factor * p.y())};
        if (ring.points.empty() || !(ring.points.back() == g)) {
            ring.points.push_back(g);
        }
    }
    while (ring.size() > 1 && ring.points.back() == ring.points.front()) {
        ring.points.pop_back();
    }
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
        const GridVector &a = ring.points[i], &b = ring.points[(i + 1) % n];
        ring.edges.push_back({b.x - a.x, b.y - a.y});
    }
    for (std::size_t i = 0; i < n; ++i) {
        ring.turns.push_back(turning(ring.edges[(i + n - 1) % n], ring.edges[i]) < 0 ? -1 : 1);
    }
    return ring;
}

//! Upper half plane (0 <= angle < pi) before the lower one.
int half(const GridVector& v)
{
    return v.y < 0 || (v.y == 0 && v.x < 0) ? 1 : 0;
}

//! Order of directions by angle; between equal ones, \p tie decides (the sign for "a after b").
bool after(const GridVector& a, const GridVector& b, int tie)
{
    if (half(a) != half(b)) {
        return half(a) > half(b);
    }
    const int t = turning(b, a);
    return t != 0 ? t > 0 : tie > 0;
}

//! Does direction \p d lie in the sector swept from \p from to \p to, turning left? Parallel directions are told
//! apart as if all of the other polygon's were turned by a hair (\p tie: d counts as after an equal direction).
bool in_sector(const GridVector& d, const GridVector& from, const GridVector& to, int tie)
{
    const bool past_from = after(d, from, tie);
    const bool past_to = after(d, to, tie);
    const bool wraps = after(from, to, 0);
    return wraps ? past_from || !past_to : past_from && !past_to;
}

//! Is the tangent at corner \p j of \p ring parallel to \p d somewhere on its way? Straight corners sweep nothing.
bool corner_meets(const Ring& ring, std::size_t j, const GridVector& d, int tie)
{
    const GridVector& in = ring.edges[(j + ring.size() - 1) % ring.size()];
    const GridVector& out = ring.edges[j];
    return ring.turns[j] > 0 ? in_sector(d, in, out, tie) : in_sector(d, out, in, tie);
}

//! One step of the convolution: an edge of one polygon moved to a corner of the other.
struct Step
{
    std::size_t from, to; //!< states: corner of a times size of b plus corner of b
};

std::vector<Step> convolution_steps(const Ring& a, const Ring& b)
{
    std::vector<Step> steps;
    const auto add = [&](std::size_t from, std::size_t to, int direction) {
        steps.push_back(direction > 0 ? Step{from, to} : Step{to, from});
    };
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            if (corner_meets(b, j, a.edges[i], 1)) {
                add(i * b.size() + j, (i + 1) % a.size() * b.size() + j, b.turns[j]);
            }
            if (corner_meets(a, i, b.edges[j], -1)) {
                add(i * b.size() + j, i * b.size() + (j + 1) % b.size(), a.turns[i]);
            }
        }
    }
    return steps;
}

//! Chains the steps to closed curves; every state is left as often as it is entered.
std::vector<Polygon> closed_curves(const Ring& a, const Ring& b)
{
    std::vector<Step> steps = convolution_steps(a, b);
    std::stable_sort(steps.begin(), steps.end(), [](const Step& s, const Step& t) { return s.from < t.from; });
    const auto point = [&](std::size_t state) {
        const GridVector &p = a.points[state / b.size()], &q = b.points[state % b.size()];
        return Vec2(static_cast<double>(p.x + q.x) / grid, static_cast<double>(p.y + q.y) / grid);
    };
    std::vector<bool> used(steps.size(), false);
    std::vector<Polygon> curves;
    for (std::size_t first = 0; first < steps.size(); ++first) {
        Polygon curve;
        for (std::size_t at = first; !used[at];) {
            used[at] = true;
            curve.push_back(point(steps[at].from));
            const std::size_t state = steps[at].to;
            auto next = std::lower_bound(steps.begin(), steps.end(), state,
                                         [](const Step& s, std::size_t key) { return s.from < key; });
            while (next != steps.end() && next->from == state && used[static_cast<std::size_t>(next - steps.begin())]) {
                ++next;
            }
            if (next == steps.end() || next->from != state) {
                break;
            }
            at = static_cast<std::size_t>(next - steps.begin());
        }
        if (curve.size() >= 3) {
            curves.push_back(std::move(curve));
        }
    }
    return curves;
}

NoFit region_of(std::vector<Polygon> contours)
{
    NoFit region;
    region.contours = std::move(contours);
    for (const Polygon& contour : region.contours) {
        for (const Vec2& p : contour) {
            region.box.min = region.box.min.cwiseMin(p);
            region.box.max = region.box.max.cwiseMax(p);
            region.reach = std::max(region.reach, p.norm());
        }
    }
    return region;
}

double squared_distance(const Vec2& p, const Vec2& a, const Vec2& b)
{
    const Vec2 ab = b - a;
    const double along = std::clamp((p - a).dot(ab) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0);
    return (p - a - along * ab).squaredNorm();
}

bool inside(const NoFit& region, const Vec2& p)
{
    bool in = false;
    for (const Polygon& contour : region.contours) {
        for (std::size_t i = 0, j = contour.size() - 1; i < contour.size(); j = i++) {
            const Vec2 &a = contour[i], &b = contour[j];
            if ((a.y() > p.y()) != (b.y() > p.y()) &&
                p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
                in = !in;
            }
        }
    }
    return in;
}

} // namespace

NoFit no_fit(const Polygon& fixed, const Polygon& moving)
{
    return region_of(united(closed_curves(ring_of(fixed, 1), ring_of(moving, -1))));
}

NoFit united(const std::vector<MovedNoFit>& regions)
{
    std::vector<Polygon> rings;
    for (const MovedNoFit& moved : regions) {
        for (Polygon contour : moved.region->contours) {
            for (Vec2& p : contour) {
                p = moved.offset + (moved.negated ? Vec2(-p) : p);
            }
            rings.push_back(std::move(contour));
        }
    }
    return region_of(united(rings));
}

NoFit turned(const NoFit& region, const Turn& t)
{
    std::vector<Polygon> contours = region.contours;
    for (Polygon& contour : contours) {
        for (Vec2& p : contour) {
            p = t * p;
        }
    }
    return region_of(std::move(contours));
}

bool overlaps(const NoFit& region, const Vec2& p, double tolerance)
{
    if ((p.array() <= region.box.min.array()).any() || (p.array() >= region.box.max.array()).any() ||
        !inside(region, p)) {
        return false;
    }
    for (const Polygon& contour : region.contours) {
        for (std::size_t i = 0, j = contour.size() - 1; i < contour.size(); j = i++) {
            if (squared_distance(p, contour[j], contour[i]) <= tolerance * tolerance) {
                return false;
            }
        }
    }
    return true;
}

double reach_along(const NoFit& region, const Vec2& direction)
{
    double reach = 0;
    for (const Polygon& contour : region.contours) {
        for (std::size_t i = 0, j = contour.size() - 1; i < contour.size(); j = i++) {
            const double a = cross_2d(direction, contour[j]), b = cross_2d(direction, contour[i]);
            if ((a <= 0 && b >= 0) || (a >= 0 && b <= 0)) {
                const double t = a == b ? 0 : a / (a - b);
                reach = std::max(reach, direction.dot(contour[j] + t * (contour[i] - contour[j])));
            }
        }
    }
    return reach;
}

} // namespace rhombloom::nesting
