#include "exporters/kerf_offset.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "core/units.h"

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

//! The pair of arcs between two points with tangents; they meet where both tangents have the same length.
Chain biarc(const Vec2& p, const Vec2& S, const Vec2& q, const Vec2& T)
{
    const auto bulge_along = [](const Vec2& t, const Vec2& c) {
        return (t.x() * c.y() - t.y() * c.x()) / (c.norm() + t.dot(c));
    };
    const Vec2 v = q - p;
    const double x = v.dot(S + T);
    const double l = v.squaredNorm() / (x + std::sqrt(x * x + 2 * (1 - S.dot(T)) * v.squaredNorm()));
    const Vec2 middle = 0.5 * (p + l * S + q - l * T);
    const Vec2 between = (v - l * (S + T)).normalized();
    return {{p, middle, bulge_along(S, middle - p)}, {middle, q, bulge_along(between, q - middle)}};
}

Chain biarcs(const Run& run, const Tool& tool, int pieces)
{
    Chain chain;
    for (int i = 0; i < pieces; ++i) {
        const double f = static_cast<double>(i) / pieces;
        const double g = static_cast<double>(i + 1) / pieces;
        const Chain pair =
            biarc(run_point(run, tool, f), run_tangent(run, f), run_point(run, tool, g), run_tangent(run, g));
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

Chain raw_offset(const Chain& contour, const Tool& tool)
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
//! \}

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

//! \name Short segments
//! \{

//! mm that a chord may leave the short lines it stands for.
constexpr double simplification = 0.002;

//! The end of the longest chord from the start of contour[from] that stays near the vertices before it.
std::size_t longest_chord(const Chain& contour, std::size_t from, std::size_t end)
{
    std::size_t best = from + 1;
    for (std::size_t last = from + 2; last <= end; ++last) {
        const Segment chord{contour[from].a, contour[last - 1].b, 0};
        for (std::size_t i = from + 1; i < last; ++i) {
            if (length(chord) < 1e-9 || distance(chord, contour[i].a) > simplification) {
                return best;
            }
        }
        best = last;
    }
    return best;
}

//! How far, in mm, neighbours may be extended to do without a short segment.
constexpr double longest_mitre = 0.25;

//! Extend or shorten both segments to where their lines or circles cross nearest to the gap between them.
bool extend_to_meet(Segment& before, Segment& after)
{
    const Vec2 gap = 0.5 * (before.b + after.a);
    double nearest = longest_mitre;
    std::pair<Segment, Segment> best;
    for (const Vec2& p : carrier_crossings(before, after)) {
        const bool enough_left = fraction(before, p) * length(before) > shortest_segment &&
                                 (1 - fraction(after, p)) * length(after) > shortest_segment;
        if (enough_left && (p - gap).norm() < nearest) {
            nearest = (p - gap).norm();
            best = {ending_at(before, p), starting_at(after, p)};
        }
    }
    if (nearest == longest_mitre) {
        return false;
    }
    before = best.first;
    after = best.second;
    return true;
}

//! Make the short segment a line that ends a little way along its longer neighbour.
void take_from_longer(Segment& before, Segment& brief, Segment& after)
{
    const double take = 1.1 * shortest_segment;
    if (length(after) >= length(before)) {
        const Vec2 p = point(after, std::min(1.0, take / length(after)));
        after = starting_at(after, p);
        brief = {brief.a, p, 0};
    } else {
        const Vec2 p = point(before, std::max(0.0, 1 - take / length(before)));
        before = ending_at(before, p);
        brief = {p, brief.b, 0};
    }
}
//! \}

int chords_within(const Segment& s, double tolerance)
{
    return is_arc(s) ? 1 + static_cast<int>(std::abs(sweep(s)) * std::sqrt(circle(s).radius / (8 * tolerance))) : 1;
}

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
    const Chain pieces = pieces_on_the_rim(raw_offset(contour, tool), contour, tool);
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

std::vector<Segment> simplified_short_runs(const std::vector<Segment>& contour)
{
    Chain result;
    const auto is_short_line = [&](const Segment& s) { return !is_arc(s) && length(s) < shortest_segment; };
    for (std::size_t i = 0; i < contour.size();) {
        std::size_t end = i;
        while (end < contour.size() && is_short_line(contour[end])) {
            ++end;
        }
        if (end < i + 2) {
            result.push_back(contour[i++]);
            continue;
        }
        for (; i < end;) {
            const std::size_t next = longest_chord(contour, i, end);
            result.push_back({contour[i].a, contour[next - 1].b, 0});
            i = next;
        }
    }
    return result;
}

std::vector<Segment> merged_short_segments(std::vector<Segment> loop)
{
    // Every pass removes a segment or makes a short one long, once each at most.
    for (std::size_t pass = 0; pass < 2 * loop.size() && loop.size() > 3; ++pass) {
        const auto brief =
            std::find_if(loop.begin(), loop.end(), [](const Segment& s) { return length(s) < shortest_segment; });
        if (brief == loop.end()) {
            break;
        }
        const std::size_t i = static_cast<std::size_t>(brief - loop.begin());
        Segment& before = loop[(i + loop.size() - 1) % loop.size()];
        Segment& after = loop[(i + 1) % loop.size()];
        if (extend_to_meet(before, after)) {
            loop.erase(brief);
        } else {
            take_from_longer(before, *brief, after);
        }
    }
    loop.erase(std::remove_if(loop.begin(), loop.end(), [](const Segment& s) { return length(s) < 1e-9; }), loop.end());
    return loop;
}

} // namespace rhombloom
