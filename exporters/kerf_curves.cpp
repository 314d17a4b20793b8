#include "exporters/kerf_curves.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "exporters/kerf.h"

namespace rhombloom {

namespace {

using Chain = std::vector<Segment>;

Vec2 right_normal(const Vec2& t)
{
    return {t.y(), -t.x()};
}

double turn_between(const Vec2& t, const Vec2& u)
{
    return std::atan2(t.x() * u.y() - t.y() * u.x(), t.dot(u));
}

//! \name Curves that the tool's centre follows round a segment or a corner
//! \{

//! A piece of contour (or, of no length, a corner) with the tangent's angle running from \p start by \p turn.
struct Run
{
    Segment base;
    double start;
    double turn;
};

Vec2 run_tangent(const Run& run, double f)
{
    const double angle = run.start + f * run.turn;
    return {std::cos(angle), std::sin(angle)};
}

Vec2 run_point(const Run& run, const Tool& tool, double f)
{
    return point(run.base, f) + rim_point(tool, right_normal(run_tangent(run, f)));
}

Chain biarcs(const Run& run, const Tool& tool, int pieces)
{
    Chain chain;
    for (int i = 0; i < pieces; ++i) {
        const double f = static_cast<double>(i) / pieces;
        const double g = static_cast<double>(i + 1) / pieces;
        const auto pair =
            biarc({run_point(run, tool, f), run_tangent(run, f)}, {run_point(run, tool, g), run_tangent(run, g)});
        chain.insert(chain.end(), pair.begin(), pair.end());
    }
    return chain;
}

double deviation(const Run& run, const Tool& tool, const Chain& chain)
{
    double worst = 0;
    for (int i = 1; i < 32; ++i) {
        const Vec2 p = run_point(run, tool, i / 32.0);
        double nearest = 1e300;
        for (const Segment& s : chain) {
            nearest = std::min(nearest, distance(s, p));
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

//! Chords of a run that doubles back on itself; the parts that do so are cut away later.
Chain chords(const Run& run, const Tool& tool)
{
    constexpr int pieces = 64;
    Chain chain;
    for (int i = 0; i < pieces; ++i) {
        chain.push_back({run_point(run, tool, static_cast<double>(i) / pieces),
                         run_point(run, tool, static_cast<double>(i + 1) / pieces), 0});
    }
    return chain;
}

//! Whether the tool's centre moves forward all along the run.
bool goes_forward(const Run& run, const Tool& tool)
{
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i) {
        const double f = (i + 0.5) / steps;
        const Vec2 step =
            run_point(run, tool, (i + 1.0) / steps) - run_point(run, tool, i / static_cast<double>(steps));
        if (step.dot(run_tangent(run, f)) <= 1e-12) {
            return false;
        }
    }
    return true;
}

Chain curve(const Run& run, const Tool& tool)
{
    if (run.turn == 0 || is_round(tool)) {
        return {{run_point(run, tool, 0), run_point(run, tool, 1), std::tan(run.turn / 4)}};
    }
    if (!goes_forward(run, tool)) {
        return chords(run, tool);
    }
    // Arcs that would be shorter than the shortest segment are no gain.
    const double run_length = (run_point(run, tool, 1) - run_point(run, tool, 0)).norm();
    const int most = std::clamp(static_cast<int>(run_length / (2 * shortest_segment)), 1, 24);
    int pieces = 1;
    while (pieces < most && deviation(run, tool, biarcs(run, tool, pieces)) > kerf_tolerance) {
        ++pieces;
    }
    return biarcs(run, tool, pieces);
}

Chain moved(const Segment& s, const Tool& tool)
{
    if (is_arc(s) && s.bulge < 0 && is_round(tool) && circle(s).radius < tool.x + 1e-9) {
        return {}; // narrower than the tool
    }
    const Vec2 t = tangent(s, 0);
    return curve({s, std::atan2(t.y(), t.x()), sweep(s)}, tool);
}
//! \}

//! \name Corners
//! \{

bool near(const Vec2& a, const Vec2& b, double slack)
{
    return (a - b).norm() < slack;
}

void bring_together(Segment& before, Segment& after)
{
    const Vec2 middle = 0.5 * (before.b + after.a);
    before.b = middle;
    after.a = middle;
}

//! Cut both segments off where they cross; the tails beyond lie inside the tool's way.
void trim(Segment& before, Segment& after)
{
    double best = -1;
    std::pair<double, double> at;
    for (const auto& place : crossings(before, after)) {
        if (place.first - place.second > best) {
            best = place.first - place.second;
            at = place;
        }
    }
    if (best > -1 && at.first > 0 && at.second < 1) {
        const Vec2 meeting = point(before, at.first);
        before = part(before, 0, at.first);
        after = part(after, at.second, 1);
        before.b = meeting;
        after.a = meeting;
    }
}

//! Join the curves of two neighbours at their corner: an arc round a convex one; trim a concave one.
Chain join(Chain& before, Chain& after, const Segment& s, const Segment& t, const Tool& tool)
{
    const Vec2 direction = tangent(s, 1);
    const double turn = turn_between(direction, tangent(t, 0));
    if (before.empty() || after.empty()) {
        return turn > 0 ? curve({{s.b, s.b, 0}, std::atan2(direction.y(), direction.x()), turn}, tool) : Chain{};
    }
    if (near(before.back().b, after.front().a, 1e-6)) {
        bring_together(before.back(), after.front());
        return {};
    }
    if (turn < 0) {
        trim(before.back(), after.front());
        return {};
    }
    return curve({{s.b, s.b, 0}, std::atan2(direction.y(), direction.x()), turn}, tool);
}

//! \}

} // namespace

bool is_round(const Tool& tool)
{
    return tool.x == tool.y;
}

Vec2 rim_point(const Tool& tool, const Vec2& normal)
{
    const Vec2 scaled(tool.x * normal.x(), tool.y * normal.y());
    return Vec2(tool.x * scaled.x(), tool.y * scaled.y()) / scaled.norm();
}

std::vector<Segment> offset_curves(const std::vector<Segment>& contour, const Tool& tool)
{
    const std::size_t n = contour.size();
    std::vector<Chain> curves;
    for (const Segment& s : contour) {
        curves.push_back(moved(s, tool));
    }
    std::vector<Chain> joins(n);
    for (std::size_t i = 0; i < n; ++i) {
        joins[i] = join(curves[i], curves[(i + 1) % n], contour[i], contour[(i + 1) % n], tool);
    }
    Chain raw;
    for (std::size_t i = 0; i < n; ++i) {
        raw.insert(raw.end(), curves[i].begin(), curves[i].end());
        raw.insert(raw.end(), joins[i].begin(), joins[i].end());
    }
    return raw;
}

} // namespace rhombloom
