#include "exporters/nesting_fragment.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace rhombloom::nesting {

namespace {

//! Slack of the room, against rounding only (mm).
constexpr double rounding = 1e-9;

//! A member in the turned pattern: the corner of its box, and the room that corner may move in.
struct Corner
{
    Vec2 at;
    Vec2 offset;
    Vec2 range;
    Placement placement;
};

struct Candidate
{
    Vec2 corner;
    std::size_t member;
    Vec2 shift;
};

std::vector<Corner> corners_of(const Pattern& pattern, double angle, const Polygon& outline, const Room& room)
{
    std::vector<Corner> corners;
    const Turn t = turn(angle);
    for (const Member& member : pattern.members) {
        Orientation o = member.orientation;
        o.angle += angle;
        const Box box = extents(outline, o);
        const Vec2 offset = t * member.offset;
        corners.push_back({offset + box.min,
                           offset,
                           Vec2(room.width, room.height) - (box.max - box.min),
                           {o.angle, o.mirrored, Vec2::Zero()}});
    }
    return corners;
}

//! All copies whose corners lie in x in [left, left + range] and in y within one range of \p bottom.
void collect(const std::vector<Corner>& corners, const Lattice& l, const Vec2& origin, std::vector<Candidate>& out)
{
    const double det = cross_2d(l.v1, l.v2);
    for (std::size_t m = 0; m < corners.size(); ++m) {
        const Corner& c = corners[m];
        if (c.range.x() < -rounding || c.range.y() < -rounding) {
            continue;
        }
        const Vec2 low = origin - c.at - Vec2(rounding, c.range.y() + rounding);
        const Vec2 high = origin - c.at + c.range + Vec2(rounding, rounding);
        Vec2 min = Vec2::Constant(1e300), max = Vec2::Constant(-1e300);
        for (const Vec2& p : {low, high, Vec2(low.x(), high.y()), Vec2(high.x(), low.y())}) {
            const Vec2 ij(cross_2d(p, l.v2) / det, cross_2d(l.v1, p) / det);
            min = min.cwiseMin(ij);
            max = max.cwiseMax(ij);
        }
        for (int j = static_cast<int>(std::floor(min.y())); j <= max.y() + 1; ++j) {
            for (int i = static_cast<int>(std::floor(min.x())); i <= max.x() + 1; ++i) {
                const Vec2 shift = i * l.v1 + j * l.v2;
                if ((shift.array() >= low.array()).all() && (shift.array() <= high.array()).all()) {
                    out.push_back({shift + c.at, m, shift});
                }
            }
        }
    }
}

bool in_band(const Candidate& c, const std::vector<Corner>& corners, double bottom)
{
    return c.corner.y() >= bottom - rounding && c.corner.y() <= bottom + corners[c.member].range.y() + rounding;
}

struct Window
{
    std::size_t count = 0;
    double bottom = 0;
};

//! The lower edge that takes most: each kind of copy has its own band above it.
Window best_window(const std::vector<Candidate>& seen, const std::vector<Corner>& corners)
{
    std::vector<std::vector<double>> heights(corners.size());
    for (const Candidate& c : seen) {
        heights[c.member].push_back(c.corner.y());
    }
    for (std::vector<double>& h : heights) {
        std::sort(h.begin(), h.end());
    }
    Window best;
    for (const Candidate& c : seen) {
        const double bottom = c.corner.y();
        std::size_t count = 0;
        for (std::size_t m = 0; m < corners.size(); ++m) {
            const auto first = std::lower_bound(heights[m].begin(), heights[m].end(), bottom - rounding);
            const auto last = std::upper_bound(first, heights[m].end(), bottom + corners[m].range.y() + rounding);
            count += static_cast<std::size_t>(last - first);
        }
        if (count > best.count) {
            best = {count, bottom};
        }
    }
    return best;
}

} // namespace

Box extents(const Polygon& outline, const Orientation& orientation)
{
    return box_of(oriented(outline, orientation));
}

std::vector<Placement> fragment(const Pattern& pattern, double angle, const Polygon& outline, const Room& room,
                                std::size_t at_least)
{
    const std::vector<Corner> corners = corners_of(pattern, angle, outline, room);
    const Turn t = turn(angle);
    const Lattice lattice{t * pattern.lattice.v1, t * pattern.lattice.v2};
    std::vector<Placement> best;
    for (const Corner& first : corners) {
        std::vector<Candidate> seen;
        collect(corners, lattice, first.at, seen);
        const Window window = best_window(seen, corners);
        if (window.count <= best.size() || window.count < at_least) {
            continue;
        }
        best.clear();
        const Vec2 origin(first.at.x(), window.bottom);
        for (const Candidate& c : seen) {
            if (in_band(c, corners, window.bottom)) {
                best.push_back(corners[c.member].placement);
                best.back().offset = corners[c.member].offset + c.shift - origin;
            }
        }
    }
    return best;
}

} // namespace rhombloom::nesting
