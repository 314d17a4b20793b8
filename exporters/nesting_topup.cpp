#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "core/units.h"
#include "exporters/nesting_improve.h"
#include "exporters/nesting_union.h"

namespace rhombloom::nesting {

namespace {

constexpr double rounding = 1e-9;

//! Copies times directions that are looked at on one sheet.
constexpr std::size_t topup_work = 700;

//! No-fit regions of the outline in any two orientations, each computed once.
class NoFits
{
public:
    explicit NoFits(const Piece& piece) : piece_(piece) {}

    const NoFit& of(const Placement& fixed, const Placement& moving)
    {
        const auto key = std::make_tuple(fixed.angle, fixed.mirrored, moving.angle, moving.mirrored);
        const auto known = regions_.find(key);
        if (known != regions_.end()) {
            return known->second;
        }
        return regions_.emplace(key, no_fit(shape(fixed), shape(moving))).first->second;
    }

private:
    Polygon shape(const Placement& p) const { return oriented(piece_.inflated, {p.angle, p.mirrored}); }

    const Piece& piece_;
    std::map<std::tuple<double, bool, double, bool>, NoFit> regions_;
};

//! Where the origin of a copy may be, as far as the room goes.
Box inner_fit(const Piece& piece, const Room& room, const Placement& p)
{
    const Box box = extents(piece.hull, {p.angle, p.mirrored});
    return {-box.min, Vec2(room.width, room.height) - box.max};
}

bool is_free(const Layout& layout, const Placement& candidate, NoFits& regions)
{
    return std::none_of(layout.begin(), layout.end(), [&](const Placement& p) {
        return overlaps(regions.of(p, candidate), candidate.offset - p.offset);
    });
}

//! A place for one more copy in the orientation of \p candidate: the lowest corner of what is free.
std::optional<Placement> free_place(const Piece& piece, const Room& room, const Layout& layout, Placement candidate,
                                    NoFits& regions)
{
    const Box fit = inner_fit(piece, room, candidate);
    if ((fit.max - fit.min).minCoeff() < 0) {
        return {};
    }
    std::vector<Polygon> taken;
    for (const Placement& p : layout) {
        for (Polygon contour : regions.of(p, candidate).contours) {
            for (Vec2& v : contour) {
                v += p.offset;
            }
            taken.push_back(std::move(contour));
        }
    }
    const Polygon all = {fit.min, {fit.max.x(), fit.min.y()}, fit.max, {fit.min.x(), fit.max.y()}};
    std::optional<Placement> lowest;
    for (const Polygon& contour : without({all}, taken)) {
        for (const Vec2& v : contour) {
            candidate.offset = v.cwiseMax(fit.min).cwiseMin(fit.max);
            const bool lower = !lowest || std::pair(v.y(), v.x()) < std::pair(lowest->offset.y(), lowest->offset.x());
            if (lower && is_free(layout, candidate, regions)) {
                lowest = candidate;
            }
        }
    }
    return lowest;
}

//! Orientations of the layout, their quarter turns and, if any angle goes, even steps.
std::vector<Placement> candidates_for(const Piece& piece, const Layout& layout)
{
    std::vector<Placement> candidates;
    const auto add = [&](double angle, bool mirrored) {
        const bool known = std::any_of(candidates.begin(), candidates.end(), [&](const Placement& c) {
            return c.mirrored == mirrored && std::abs(std::remainder(c.angle - angle, two_pi)) < 1e-9;
        });
        if (!known) {
            candidates.push_back({angle, mirrored, Vec2::Zero()});
        }
    };
    for (const Placement& p : layout) {
        add(p.angle, p.mirrored);
        if (piece.grain != Grain::Fixed) {
            add(p.angle + pi, p.mirrored);
        }
    }
    if (piece.grain == Grain::Any) {
        const double base = layout.front().angle;
        for (int i = 1; i < 24; ++i) {
            add(base + pi / 2 * (i % 4) + pi / 12 * (i / 4), false);
        }
    }
    candidates.resize(std::min(candidates.size(), std::max<std::size_t>(2, topup_work / layout.size())));
    return candidates;
}

Layout filled_up(const Piece& piece, const Room& room, Layout layout, NoFits& regions)
{
    for (const Placement& candidate : candidates_for(piece, layout)) {
        while (const auto place = free_place(piece, room, layout, candidate, regions)) {
            layout.push_back(*place);
        }
    }
    return layout;
}

//! How far a copy at \p from may slide along the unit vector \p way before it enters \p region.
double free_run(const NoFit& region, const Vec2& from, const Vec2& way)
{
    double run = 1e300;
    for (const Polygon& contour : region.contours) {
        for (std::size_t i = 0, j = contour.size() - 1; i < contour.size(); j = i++) {
            const double a = cross_2d(way, contour[j] - from), b = cross_2d(way, contour[i] - from);
            if (a > 0 && b <= 0) { // the edge of a counter-clockwise contour is crossed inwards
                const double t = way.dot(contour[j] + a / (a - b) * (contour[i] - contour[j]) - from);
                run = t > -1e-6 ? std::min(run, t) : run;
            }
        }
    }
    return std::max(0.0, run);
}

//! Every copy slides towards \p way (along an axis) as far as the others let it.
void slide(const Piece& piece, const Room& room, const Vec2& way, Layout& layout, NoFits& regions)
{
    std::stable_sort(layout.begin(), layout.end(),
                     [&](const Placement& a, const Placement& b) { return way.dot(a.offset) > way.dot(b.offset); });
    for (Placement& p : layout) {
        const Box fit = inner_fit(piece, room, p);
        double run = std::max(0.0, std::max(way.dot(fit.max), way.dot(fit.min)) - way.dot(p.offset));
        for (const Placement& other : layout) {
            if (&other != &p) {
                run = std::min(run, free_run(regions.of(other, p), p.offset - other.offset, way));
            }
        }
        const Vec2 from = p.offset;
        p.offset = (p.offset + run * way).cwiseMax(fit.min).cwiseMin(fit.max);
        const Placement moved = p;
        const bool clear = std::none_of(layout.begin(), layout.end(), [&](const Placement& other) {
            return &other != &p && overlaps(regions.of(other, moved), moved.offset - other.offset);
        });
        p.offset = clear ? p.offset : from;
    }
}

//! The layout pushed as a whole into a corner (signs of \p corner).
Layout pushed(const Piece& piece, const Room& room, Layout layout, const Vec2& corner)
{
    Vec2 low = Vec2::Constant(1e300), high = Vec2::Constant(-1e300);
    for (const Placement& p : layout) {
        const Box box = extents(piece.hull, {p.angle, p.mirrored});
        low = low.cwiseMin(p.offset + box.min);
        high = high.cwiseMax(p.offset + box.max);
    }
    const Vec2 size(room.width, room.height);
    const Vec2 move(corner.x() < 0 ? -low.x() : size.x() - high.x(), corner.y() < 0 ? -low.y() : size.y() - high.y());
    for (Placement& p : layout) {
        p.offset += move;
    }
    return layout;
}

} // namespace

Layout topped_up(const Piece& piece, const Room& room, const Layout& layout)
{
    if (layout.empty() || layout.size() > topup_work / 2) {
        return layout;
    }
    NoFits regions(piece);
    Layout best = layout;
    for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(-1, 1), Vec2(1, 1)}) {
        Layout tight = pushed(piece, room, layout, corner);
        for (int pass = 0; pass < 2; ++pass) {
            Layout more = filled_up(piece, room, tight, regions);
            if (more.size() > best.size()) {
                best = std::move(more);
            }
            slide(piece, room, Vec2(corner.x(), 0), tight, regions);
            slide(piece, room, Vec2(0, corner.y()), tight, regions);
        }
    }
    return best;
}

} // namespace rhombloom::nesting
