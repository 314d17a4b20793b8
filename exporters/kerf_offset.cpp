#include "exporters/kerf_offset.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace rhombloom {

namespace {

using Chain = std::vector<Segment>;

void bring_together(Segment& before, Segment& after)
{
    const Vec2 middle = 0.5 * (before.b + after.a);
    before.b = middle;
    after.a = middle;
}

//! \name Cutting away what lies inside the tool's way
//! \{

std::vector<double> split_places(const Chain& raw, std::size_t i)
{
    std::vector<double> places = {0, 1};
    const double slack = 1e-6 / length(raw[i]);
    for (std::size_t j = 0; j < raw.size(); ++j) {
        if (j == i) {
            continue;
        }
        for (const auto& at : crossings(raw[i], raw[j])) {
            if (at.first > slack && at.first < 1 - slack) {
                places.push_back(at.first);
            }
        }
    }
    std::sort(places.begin(), places.end());
    return places;
}

//! How much closer than the tool's rim a piece may be and still count as on it, in units of the tool.
double slack_of(const Tool& tool)
{
    return (is_round(tool) ? 1e-6 : 1e-3) / std::min(tool.x, tool.y);
}

//! The parts of the raw curves that no other part of the contour comes nearer to than the tool allows.
Chain pieces_on_the_rim(const Chain& raw, const Chain& contour, const Tool& tool)
{
    const double least = 1 - slack_of(tool);
    Chain kept;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const std::vector<double> places = split_places(raw, i);
        double from = -1;
        for (std::size_t k = 0; k + 1 < places.size(); ++k) {
            const Vec2 middle = point(raw[i], 0.5 * (places[k] + places[k + 1]));
            const bool on_rim = tool_distance(tool, contour, middle) >= least;
            from = on_rim && from < 0 ? places[k] : from;
            const bool last = k + 2 == places.size();
            if (from >= 0 && (!on_rim || last)) {
                kept.push_back(part(raw[i], from, on_rim ? places[k + 1] : places[k]));
                from = -1;
            }
        }
    }
    return kept;
}

//! The unused piece whose start lies nearest to \p end.
std::size_t next_piece(const Chain& pieces, const std::vector<bool>& used, const Vec2& end, double reach)
{
    std::size_t best = pieces.size();
    double nearest = reach;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (!used[i] && (pieces[i].a - end).norm() < nearest) {
            nearest = (pieces[i].a - end).norm();
            best = i;
        }
    }
    return best;
}

Expected<Chain> loop_from(const Chain& pieces, std::vector<bool>& used, std::size_t first, double reach)
{
    Chain loop = {pieces[first]};
    used[first] = true;
    for (;;) {
        const std::size_t next = next_piece(pieces, used, loop.back().b, reach);
        const double closing = (loop.back().b - loop.front().a).norm();
        if (closing < reach && (next == pieces.size() || closing < (pieces[next].a - loop.back().b).norm())) {
            bring_together(loop.back(), loop.front());
            return loop;
        }
        if (next == pieces.size()) {
            const Vec2 at = loop.back().b;
            return refuse("kerf: the contour cannot be moved near (" + to_fixed(at.x(), 2) + ", " +
                          to_fixed(at.y(), 2) + ") mm; use a narrower kerf");
        }
        used[next] = true;
        loop.push_back(pieces[next]);
        bring_together(loop[loop.size() - 2], loop.back());
    }
}
//! \}

int chords_within(const Segment& s, double tolerance)
{
    return is_arc(s) ? 1 + static_cast<int>(std::abs(sweep(s)) * std::sqrt(circle(s).radius / (8 * tolerance))) : 1;
}

} // namespace

double tool_distance(const Tool& tool, const std::vector<Segment>& contour, const Vec2& p)
{
    double nearest = 1e300;
    if (is_round(tool)) {
        for (const Segment& s : contour) {
            const double least = (p - 0.5 * (s.a + s.b)).norm() - 0.5 * (s.b - s.a).norm();
            nearest = least / tool.x < nearest ? std::min(nearest, distance(s, p) / tool.x) : nearest;
        }
        return nearest;
    }
    const auto scaled = [&](const Vec2& q) { return Vec2(q.x() / tool.x, q.y() / tool.y); };
    for (const Segment& s : contour) {
        if ((p - 0.5 * (s.a + s.b)).norm() > 0.5 * length(s) + 4 * std::max(tool.x, tool.y)) {
            continue; // farther than 4 tools
        }
        const int chord_count = chords_within(s, 1e-6);
        for (int k = 0; k < chord_count; ++k) {
            const Segment chord{scaled(point(s, static_cast<double>(k) / chord_count)),
                                scaled(point(s, static_cast<double>(k + 1) / chord_count)), 0};
            nearest = std::min(nearest, distance(chord, scaled(p)));
        }
    }
    return nearest;
}

Expected<std::vector<std::vector<Segment>>> offset_loops(const std::vector<Segment>& contour, const Tool& tool)
{
    const Chain pieces = pieces_on_the_rim(offset_curves(contour, tool), contour, tool);
    const double reach = is_round(tool) ? 1e-4 : 0.01;
    std::vector<bool> used(pieces.size(), false);
    std::vector<Chain> loops;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (used[i]) {
            continue;
        }
        auto loop = loop_from(pieces, used, i, reach);
        if (!loop) {
            return tl::make_unexpected(loop.error());
        }
        loops.push_back(std::move(*loop));
    }
    return loops;
}

} // namespace rhombloom
