#include "exporters/nesting_layout.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace rhombloom::nesting {

namespace {

//! Rounded corners stray so far from the true offset (mm), and simplified boundaries at most so far.
constexpr double corner_slack = 0.01;
constexpr double simplification = 0.03;

std::vector<Placement> best_fragment(const Piece& piece, const Room& room)
{
    std::vector<Placement> best;
    const std::vector<Lattice> found = lattices(piece.self, {});
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Pattern pattern{found[i]};
        for (const double angle : angles_for(pattern, piece.grain, i < 40 ? 180 : 0)) {
            std::vector<Placement> layout = fragment(pattern, angle, piece.hull, room);
            if (layout.size() > best.size()) {
                best = std::move(layout);
            }
        }
    }
    return best;
}

double top_of(const Placement& placement, const Piece& piece)
{
    return extents(piece.hull, {placement.angle, placement.mirrored}).max.y() + placement.offset.y();
}

} // namespace

Piece piece_of(const Polygon& outline, const NestOptions& options)
{
    Piece piece;
    piece.hull = convex_hull(outline);
    piece.inflated = inflated(outline, options.spacing / 2, corner_slack);
    piece.inflated = simplified_outward(piece.inflated, simplification);
    piece.self = no_fit(piece.inflated, piece.inflated);
    piece.grain = options.grain;
    piece.mirror = options.mirror;
    return piece;
}

std::vector<double> angles_for(const Pattern& pattern, Grain grain, int count)
{
    if (grain != Grain::Any) {
        return {0};
    }
    std::vector<double> angles = {0, pi / 2};
    const Lattice& l = pattern.lattice;
    for (const Vec2& v : {l.v1, l.v2, Vec2(l.v1 + l.v2), Vec2(l.v1 - l.v2)}) {
        const double along = -std::atan2(v.y(), v.x());
        angles.push_back(along);
        angles.push_back(along + pi / 2);
    }
    for (int i = 0; i < count; ++i) {
        angles.push_back(pi * i / count);
    }
    return angles;
}

bool fits(const Piece& piece, const Room& room)
{
    Pattern single{{Vec2(4 * piece.self.reach, 0), Vec2(0, 4 * piece.self.reach)}};
    const auto angles = angles_for(single, piece.grain, 720);
    return std::any_of(angles.begin(), angles.end(),
                       [&](double angle) { return !fragment(single, angle, piece.hull, room).empty(); });
}

std::vector<Placement> densest_layout(const Piece& piece, const Room& room, int wanted)
{
    std::vector<Placement> layout = best_fragment(piece, room);
    return std::ssize(layout) > wanted ? packed_layout(piece, room, layout, wanted) : layout;
}

std::vector<Placement> packed_layout(const Piece& piece, const Room&, const std::vector<Placement>& full, int count)
{
    std::vector<Placement> layout = full;
    std::stable_sort(layout.begin(), layout.end(),
                     [&](const Placement& a, const Placement& b) { return top_of(a, piece) < top_of(b, piece); });
    layout.resize(static_cast<std::size_t>(count));
    return layout;
}

} // namespace rhombloom::nesting
