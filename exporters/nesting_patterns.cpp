// Which patterns a piece can be repeated in, and at which angles they are tried.
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "exporters/nesting_double.h"
#include "exporters/nesting_layout.h"

namespace rhombloom::nesting {

namespace {

//! Rounded corners stray so far from the true offset (mm), and simplified boundaries at most so far.
constexpr double corner_slack = 0.01;
constexpr double simplification = 0.03;

//! Work of all trials in a room, in copies looked at.
constexpr double trial_work = 4e6;

//! Turns of a mirrored mate that lay one of its long edges against a long edge of the drawn copy.
std::vector<double> facing_turns(const Polygon& outline)
{
    const std::vector<Vec2> edges = long_edges(outline, 3);
    std::vector<double> turns = {0, pi};
    for (const Vec2& a : edges) {
        for (const Vec2& b : edges) {
            // The mirrored edge b has the direction pi - arg(b); reversed order of points turns it to -arg(b).
            const double t = std::atan2(a.y(), a.x()) + pi + std::atan2(b.y(), b.x());
            const bool known = std::any_of(turns.begin(), turns.end(),
                                           [&](double u) { return std::abs(std::remainder(t - u, two_pi)) < 1e-6; });
            if (!known) {
                turns.push_back(t);
            }
        }
    }
    return turns;
}

std::vector<Orientation> allowed_mates(const Piece& piece)
{
    std::vector<Orientation> mates;
    if (piece.grain != Grain::Fixed) {
        mates.push_back({pi, false});
    }
    if (piece.mirror == Mirror::Never) {
        return mates;
    }
    const std::vector<double> turns = piece.grain == Grain::Any        ? facing_turns(piece.inflated)
                                      : piece.grain == Grain::HalfTurn ? std::vector<double>{0, pi}
                                                                       : std::vector<double>{0};
    for (const double t : turns) {
        mates.push_back({t, true});
    }
    return mates;
}

LatticeSearch lattice_search(Grain grain)
{
    LatticeSearch search;
    if (grain != Grain::Any) { // only one angle to try: more lattices instead
        search.worst = 1.3;
        search.keep = 4000;
    }
    return search;
}

std::vector<Pattern> patterns_of(const Piece& piece)
{
    std::vector<Pattern> patterns;
    for (const Lattice& lattice : lattices(piece.self, lattice_search(piece.grain))) {
        patterns.push_back({lattice});
    }
    for (const Orientation& mate : allowed_mates(piece)) {
        const auto found = double_patterns(mates_of(piece.inflated, piece.self, mate), 30);
        patterns.insert(patterns.end(), found.begin(), found.end());
    }
    std::stable_sort(patterns.begin(), patterns.end(),
                     [](const Pattern& a, const Pattern& b) { return a.area_per_copy() < b.area_per_copy(); });
    return patterns;
}

//! Angles that lay a short vector of the pattern along a side of the sheet.
std::vector<double> aligned_angles(const Pattern& pattern)
{
    std::vector<double> angles = {0, pi / 2};
    const Lattice& l = pattern.lattice;
    for (const Vec2& v : {l.v1, l.v2, Vec2(l.v1 + l.v2), Vec2(l.v1 - l.v2)}) {
        const double along = -std::atan2(v.y(), v.x());
        angles.push_back(along);
        angles.push_back(along + pi / 2);
    }
    return angles;
}

void add_trials(const Pattern& pattern, const std::vector<double>& angles, bool even, std::vector<Trial>& trials)
{
    for (const double angle : angles) {
        trials.push_back({&pattern, angle, even});
    }
}

std::vector<double> even_angles(int count)
{
    std::vector<double> angles;
    for (int i = 0; i < count; ++i) {
        angles.push_back(pi * i / count);
    }
    return angles;
}

} // namespace

Piece piece_of(const Polygon& outline, const NestOptions& options)
{
    Piece piece;
    piece.hull = convex_hull(outline);
    piece.inflated = inflated(outline, options.spacing / 2, corner_slack);
    piece.inflated = simplified_outward(piece.inflated, simplification);
    piece.self = no_fit(piece.inflated, piece.inflated);
    piece.turned = no_fit(piece.inflated, oriented(piece.inflated, {pi, false}));
    piece.spacing = options.spacing;
    piece.grain = options.grain;
    piece.mirror = options.mirror;
    piece.patterns = patterns_of(piece);
    return piece;
}

std::vector<Trial> trials_for(const Piece& piece, const Room& room)
{
    std::vector<Trial> trials;
    if (piece.patterns.empty()) {
        return trials;
    }
    const double copies = room.width * room.height / piece.patterns.front().area_per_copy() + 20;
    const auto most = static_cast<std::size_t>(std::clamp(trial_work / copies, 300.0, 40000.0));
    const std::vector<double> even = even_angles(180);
    for (std::size_t i = 0; i < piece.patterns.size() && trials.size() < most; ++i) {
        const Pattern& pattern = piece.patterns[i];
        if (piece.grain != Grain::Any) {
            trials.push_back({&pattern, 0, false});
            continue;
        }
        add_trials(pattern, aligned_angles(pattern), false, trials);
        if (i % 4 == 0 && i < 160) {
            add_trials(pattern, even, true, trials);
        }
    }
    trials.resize(std::min(trials.size(), most));
    return trials;
}

} // namespace rhombloom::nesting
