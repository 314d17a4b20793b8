#include <algorithm>
#include <optional>

#include "exporters/nesting_polygon.h"
#include "exporters/nesting_union.h"

namespace rhombloom::nesting {

namespace {

//! A vertex and how far (at most) the edge that follows it lies outside the original boundary.
struct Corner
{
    Vec2 p;
    double strayed = 0;
};

double distance_to_line(const Vec2& p, const Vec2& a, const Vec2& b)
{
    const double length = (b - a).norm();
    return length > 0 ? std::abs(cross_2d(b - a, p - a)) / length : (p - a).norm();
}

//! Where the edges before b and after c meet when the edge b-c is dropped; nothing unless both corners are convex.
std::optional<Vec2> tip_over(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const Vec2 in = b - a, out = d - c;
    const double between = cross_2d(in, out);
    if (cross_2d(in, c - b) < 0 || cross_2d(c - b, out) < 0 || between <= 1e-9 * in.norm() * out.norm()) {
        return {};
    }
    return Vec2(b + in * (cross_2d(c - b, out) / between));
}

//! Drop vertex \p i if it is reflex and the new edge strays no further than \p tolerance.
bool cut_across(std::vector<Corner>& ring, std::size_t i, double tolerance)
{
    const std::size_t n = ring.size();
    Corner& before = ring[(i + n - 1) % n];
    const Corner& after = ring[(i + 1) % n];
    if (cross_2d(ring[i].p - before.p, after.p - ring[i].p) > 0) {
        return false;
    }
    const double strayed = std::max(before.strayed, ring[i].strayed) + distance_to_line(ring[i].p, before.p, after.p);
    if (strayed > tolerance) {
        return false;
    }
    before.strayed = strayed;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
}

//! Replace the edge from vertex \p i to the next by the point where its neighbours meet.
bool extend_over(std::vector<Corner>& ring, std::size_t i, double tolerance)
{
    const std::size_t n = ring.size();
    const std::size_t j = (i + 1) % n;
    const auto tip = tip_over(ring[(i + n - 1) % n].p, ring[i].p, ring[j].p, ring[(i + 2) % n].p);
    if (!tip || ring[i].strayed + distance_to_line(*tip, ring[i].p, ring[j].p) > tolerance) {
        return false;
    }
    ring[i] = {*tip, ring[j].strayed};
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(j));
    return true;
}

bool sweep_round(std::vector<Corner>& ring, double tolerance)
{
    bool changed = false;
    for (std::size_t i = 0; i < ring.size() && ring.size() > 4; ++i) {
        changed |= cut_across(ring, i, tolerance) || extend_over(ring, i, tolerance);
    }
    return changed;
}

} // namespace

Polygon simplified_outward(const Polygon& polygon, double tolerance)
{
    std::vector<Corner> ring;
    for (const Vec2& p : polygon) {
        ring.push_back({p, 0});
    }
    for (const double share : {0.0, 0.1, 0.3, 1.0}) {
        while (sweep_round(ring, share * tolerance)) {
        }
    }
    Polygon result;
    for (const Corner& corner : ring) {
        result.push_back(corner.p);
    }
    return outer_contour(result);
}

} // namespace rhombloom::nesting
