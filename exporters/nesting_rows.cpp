#include "exporters/nesting_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/form/parallel.h"
#include "core/units.h"
#include "exporters/nesting_double.h"
#include "exporters/nesting_skyline.h"

namespace rhombloom::nesting {

namespace {

constexpr double rounding = 1e-9;
constexpr std::size_t beam_width = 16;
constexpr std::size_t rows_looked_back = 3;

//! A row drawn (kind 0) or turned (kind 1): reference point of its first copy.
struct Row
{
    std::size_t kind = 0;
    Vec2 at = Vec2::Zero();
    int copies = 0;
};

struct Stack
{
    std::vector<Row> rows;
    int copies = 0;
    double top = 0;
};

//! Everything that is the same for all stacks of one angle and pitch.
struct Loom
{
    Room room;
    double pitch = 0;
    std::array<Box, 2> box;
    std::size_t kinds = 1;
    std::vector<Skyline> skylines; //!< below kind times 2 plus above kind
    std::vector<std::vector<double>> valleys;

    double range() const { return room.width - (box[0].max.x() - box[0].min.x()); }
    std::size_t pair(std::size_t below, std::size_t above) const { return 2 * below + above; }
};

Loom loom_of(const Piece& piece, const Room& room, double angle, double pitch)
{
    const Turn t = turn(angle);
    Loom loom{room,
              pitch,
              {extents(piece.hull, {angle, false}), extents(piece.hull, {angle + pi, false})},
              piece.grain == Grain::Fixed ? 1U : 2U,
              {},
              {}};
    const std::array<std::pair<const NoFit*, Sense>, 4> pairs = {{{&piece.self, Sense::Forward},
                                                                  {&piece.turned, Sense::Forward},
                                                                  {&piece.turned, Sense::Reversed},
                                                                  {&piece.self, Sense::Forward}}};
    for (const auto& [region, sense] : pairs) {
        loom.skylines.emplace_back(*region, t, sense, pitch);
        loom.valleys.push_back(loom.skylines.back().valleys());
    }
    return loom;
}

//! The row of \p kind whose copies lie at \p x plus multiples of the pitch; no copies when none fits.
Row row_at(const Loom& loom, std::size_t kind, double x)
{
    const double left = -loom.box[kind].min.x(), range = loom.range();
    double shift = x - left;
    shift -= loom.pitch * std::floor(shift / loom.pitch + rounding);
    shift = std::max(shift, 0.0);
    if (shift > range + rounding) {
        return {};
    }
    return {kind, Vec2(left + shift, 0), static_cast<int>(std::floor((range - shift + rounding) / loom.pitch)) + 1};
}

std::optional<Stack> stacked(const Loom& loom, const Stack& stack, std::size_t kind, double x)
{
    Row row = row_at(loom, kind, x);
    if (row.copies == 0) {
        return {};
    }
    row.at.y() = -loom.box[kind].min.y();
    const std::size_t first = stack.rows.size() - std::min(stack.rows.size(), rows_looked_back);
    for (std::size_t i = first; i < stack.rows.size(); ++i) {
        const Row& below = stack.rows[i];
        const Skyline& skyline = loom.skylines[loom.pair(below.kind, kind)];
        row.at.y() = std::max(row.at.y(), below.at.y() + skyline.at(row.at.x() - below.at.x()));
    }
    const double top = row.at.y() + loom.box[kind].max.y();
    if (top > loom.room.height + rounding) {
        return {};
    }
    Stack taller = stack;
    taller.rows.push_back(row);
    taller.copies += row.copies;
    taller.top = std::max(stack.top, top);
    return taller;
}

//! Shifts worth trying for a row of \p kind above \p stack.
std::vector<double> shifts_for(const Loom& loom, const Stack& stack, std::size_t kind)
{
    const double left = -loom.box[kind].min.x(), range = loom.range();
    std::vector<double> shifts = {left, left + range - loom.pitch * std::floor(range / loom.pitch + rounding)};
    if (!stack.rows.empty()) {
        const Row& below = stack.rows.back();
        for (const double valley : loom.valleys[loom.pair(below.kind, kind)]) {
            shifts.push_back(below.at.x() + valley);
        }
    }
    return shifts;
}

//! Most copies first; of equals the lowest.
bool better(const Stack& a, const Stack& b)
{
    return a.copies != b.copies ? a.copies > b.copies : a.top < b.top;
}

//! Of every number of copies a few of the lowest stacks.
void thin_out(std::vector<Stack>& beam)
{
    std::stable_sort(beam.begin(), beam.end(), better);
    std::vector<Stack> kept;
    std::size_t alike = 0;
    for (Stack& stack : beam) {
        alike = !kept.empty() && kept.back().copies == stack.copies ? alike + 1 : 0;
        if (alike < 4 && kept.size() < beam_width) {
            kept.push_back(std::move(stack));
        }
    }
    beam = std::move(kept);
}

Stack best_stack(const Loom& loom)
{
    Stack best;
    std::vector<Stack> beam = {Stack{}};
    while (!beam.empty()) {
        std::vector<Stack> next;
        for (const Stack& stack : beam) {
            for (std::size_t kind = 0; kind < loom.kinds; ++kind) {
                for (const double x : shifts_for(loom, stack, kind)) {
                    if (auto taller = stacked(loom, stack, kind, x)) {
                        next.push_back(std::move(*taller));
                    }
                }
            }
        }
        thin_out(next);
        if (!next.empty() && better(next.front(), best)) {
            best = next.front();
        }
        beam = std::move(next);
    }
    return best;
}

Layout layout_of(const Loom& loom, const Stack& stack, double angle)
{
    Layout layout;
    for (const Row& row : stack.rows) {
        for (int i = 0; i < row.copies; ++i) {
            layout.push_back({row.kind == 0 ? angle : angle + pi, false, row.at + Vec2(i * loom.pitch, 0)});
        }
    }
    return layout;
}

//! Pitches from the closest to the one that spreads the copies over the whole width.
std::vector<double> pitches_for(const Piece& piece, const Room& room, double angle)
{
    const Turn back = turn(-angle);
    const double closest = reach_along(piece.self, back * Vec2(1, 0));
    const Box box = extents(piece.hull, {angle, false});
    const double range = room.width - (box.max.x() - box.min.x());
    std::vector<double> pitches = {closest};
    const double gaps = std::floor(range / closest + rounding);
    if (gaps >= 1) {
        pitches.push_back(0.5 * (closest + range / gaps));
        pitches.push_back(range / gaps);
    }
    return pitches;
}

//! A layout made for the room lying on its side.
Layout stood_up(Layout layout, const Room& room)
{
    for (Placement& placement : layout) {
        placement.angle += pi / 2;
        placement.offset = Vec2(room.width - placement.offset.y(), placement.offset.x());
    }
    return layout;
}

std::vector<double> row_angles(const Piece& piece)
{
    if (piece.grain != Grain::Any) {
        return {0};
    }
    std::vector<double> angles;
    constexpr int steps = 90;
    for (int i = 0; i < steps; ++i) {
        angles.push_back(pi * i / steps);
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(piece.patterns.size(), 12); ++i) {
        const Lattice& l = piece.patterns[i].lattice;
        for (const Vec2& v : {l.v1, l.v2, Vec2(l.v1 + l.v2), Vec2(l.v1 - l.v2)}) {
            angles.push_back(-std::atan2(v.y(), v.x()));
        }
    }
    for (const Vec2& edge : long_edges(piece.hull, 4)) {
        angles.push_back(-std::atan2(edge.y(), edge.x()));
    }
    return angles;
}

} // namespace

Layout stacked_rows(const Piece& piece, const Room& room, double angle)
{
    Layout best;
    for (const double pitch : pitches_for(piece, room, angle)) {
        const Loom loom = loom_of(piece, room, angle, pitch);
        const Stack stack = best_stack(loom);
        if (stack.copies > std::ssize(best)) {
            best = layout_of(loom, stack, angle);
        }
    }
    return best;
}

namespace {

struct TwoWays
{
    Layout across;  //!< rows along the sheet's width
    Layout upright; //!< rows along its height
};

//! Each angle on its own, on all cores; what is chosen afterwards does not depend on which thread was first.
std::vector<TwoWays> rows_at(const Piece& piece, const Room& room, const std::vector<double>& angles)
{
    const Room lying{room.height, room.width};
    std::vector<TwoWays> rows(angles.size());
    parallel_tasks(default_threads(), static_cast<int>(angles.size()), [&](int i) {
        const double lying_angle = piece.grain == Grain::Any ? angles[i] : angles[i] - pi / 2;
        rows[i] = {stacked_rows(piece, room, angles[i]), stacked_rows(piece, lying, lying_angle)};
    });
    return rows;
}

} // namespace

Layout best_rows(const Piece& piece, const Room& room, std::size_t more_than)
{
    Layout best;
    for (TwoWays& rows : rows_at(piece, room, row_angles(piece))) {
        if (rows.across.size() > std::max(best.size(), more_than)) {
            best = std::move(rows.across);
        }
        if (rows.upright.size() > std::max(best.size(), more_than)) {
            best = stood_up(std::move(rows.upright), room);
        }
    }
    return best;
}

} // namespace rhombloom::nesting
