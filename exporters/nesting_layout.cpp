#include "exporters/nesting_layout.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "exporters/nesting_improve.h"
#include "exporters/nesting_rows.h"
#include "exporters/nesting_squeeze.h"

namespace rhombloom::nesting {

namespace {

Vec2 upper_right(const Placement& placement, const Piece& piece)
{
    return extents(piece.hull, {placement.angle, placement.mirrored}).max + placement.offset;
}

//! The copies that end lowest (\p axis 1) or furthest left (0).
Layout first_copies(const Piece& piece, const Layout& full, int count, int axis)
{
    Layout layout = full;
    std::stable_sort(layout.begin(), layout.end(), [&](const Placement& a, const Placement& b) {
        return upper_right(a, piece)[axis] < upper_right(b, piece)[axis];
    });
    layout.resize(static_cast<std::size_t>(count));
    return layout;
}

double extent_of(const Layout& layout, const Piece& piece, int axis)
{
    return upper_right(layout, piece)[axis];
}

Room cut_to(const Room& room, double extent, int axis)
{
    return axis == 1 ? Room{room.width, extent} : Room{extent, room.height};
}

//! Shrinks the room of one trial as long as \p best's number of copies fits.
void shrink(const Trial& trial, const Piece& piece, const Room& room, int axis, Layout& best)
{
    constexpr double resolution = 0.05;
    double low = 0, high = extent_of(best, piece, axis);
    double probe = high - resolution;
    while (probe > low) {
        const Room cut = cut_to(room, probe, axis);
        Layout layout = fragment(*trial.pattern, trial.angle, piece.hull, cut, best.size());
        if (layout.empty()) {
            low = probe;
            if (low >= high - resolution) {
                return;
            }
        } else {
            layout = first_copies(piece, layout, static_cast<int>(best.size()), axis);
            high = extent_of(layout, piece, axis);
            best = std::move(layout);
        }
        probe = high - low > 2 * resolution ? 0.5 * (low + high) : high - resolution;
    }
}

Layout packed_along(const Piece& piece, const Room& room, const Layout& full, int count, int axis)
{
    Layout best = first_copies(piece, full, count, axis);
    for (const Trial& trial : trials_for(piece, room)) {
        shrink(trial, piece, room, axis, best);
    }
    return best;
}

bool is_worth_squeezing(long per_sheet, long wanted, Effort effort)
{
    if (per_sheet == 0 || effort == Effort::Quick) {
        return false;
    }
    const auto sheets = [&](long copies) { return (wanted + copies - 1) / copies; };
    return effort == Effort::FillSheets ? wanted > per_sheet : sheets(per_sheet + 1) < sheets(per_sheet);
}

//! Angles at which a copy that nearly fills the room may fit: quarter turns, edges along a side, small steps.
std::vector<double> fitting_angles(const Piece& piece)
{
    std::vector<double> angles = {0};
    if (piece.grain != Grain::Any) {
        return angles;
    }
    angles.push_back(pi / 2);
    for (std::size_t i = 0; i < piece.hull.size(); ++i) {
        const Vec2 edge = piece.hull[(i + 1) % piece.hull.size()] - piece.hull[i];
        angles.push_back(-std::atan2(edge.y(), edge.x()));
        angles.push_back(angles.back() + pi / 2);
    }
    constexpr int steps = 3600;
    for (int i = 0; i < steps; ++i) {
        angles.push_back(pi * i / steps);
    }
    return angles;
}

} // namespace

Vec2 upper_right(const Layout& layout, const Piece& piece)
{
    Vec2 corner = Vec2::Zero();
    for (const Placement& placement : layout) {
        corner = corner.cwiseMax(upper_right(placement, piece));
    }
    return corner;
}

Layout single_copy(const Piece& piece, const Room& room)
{
    for (const double angle : fitting_angles(piece)) {
        const Box box = extents(piece.hull, {angle, false});
        const Vec2 size = box.max - box.min;
        if (size.x() <= room.width + 1e-9 && size.y() <= room.height + 1e-9) {
            return {{angle, false, -box.min}};
        }
    }
    return {};
}

Layout densest_layout(const Piece& piece, const Room& room, int wanted, Effort effort)
{
    Layout best = single_copy(piece, room);
    for (const Trial& trial : trials_for(piece, room)) {
        Layout layout = fragment(*trial.pattern, trial.angle, piece.hull, room, best.size() + 1);
        if (!layout.empty()) {
            best = std::move(layout);
        }
    }
    for (const auto search : {best_rows, best_blocks}) {
        Layout layout = search(piece, room, best.size());
        if (!layout.empty()) {
            best = std::move(layout);
        }
    }
    best = topped_up(piece, room, best);
    while (is_worth_squeezing(std::ssize(best), wanted, effort)) {
        Layout more = squeezed(piece, room, best);
        if (more.empty()) {
            break;
        }
        best = std::move(more);
    }
    return best;
}

Layout packed_layout(const Piece& piece, const Room& room, const Layout& full, int count)
{
    if (count == std::ssize(full)) {
        return full;
    }
    const Layout low = packed_along(piece, room, full, count, 1), left = packed_along(piece, room, full, count, 0);
    const double above = room.width * (room.height - extent_of(low, piece, 1));
    const double beside = (room.width - extent_of(left, piece, 0)) * room.height;
    return above >= beside ? low : left;
}

} // namespace rhombloom::nesting
