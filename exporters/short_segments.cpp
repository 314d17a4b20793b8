#include "exporters/short_segments.h"

#include <algorithm>
#include <cmath>

#include "exporters/kerf.h"

namespace rhombloom {

namespace {

using Chain = std::vector<Segment>;

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

} // namespace

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
