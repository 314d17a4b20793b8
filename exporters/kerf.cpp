#include "exporters/kerf.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/text.h"
#include "exporters/kerf_fitted.h"
#include "exporters/kerf_offset.h"
#include "exporters/short_segments.h"

namespace rhombloom {

namespace {

using Chain = std::vector<Segment>;

Tool tool_of(const Kerf& kerf)
{
    const double least = 0.0005;
    return {std::max(kerf.x / 2, least), std::max(kerf.y / 2, least)};
}

std::string place(const Vec2& p)
{
    return "(" + to_fixed(p.x(), 2) + ", " + to_fixed(p.y(), 2) + ") mm";
}

//! \name Slits
//! \{

//! A gap between two antiparallel lines of the contour, the segments between them being its bottom.
struct Slit
{
    std::size_t first; //!< index of the line that leads to the bottom
    std::size_t last;  //!< index of the line that leads back out
    double width;
    double reach; //!< from the mouth to the middle of the bottom
    Vec2 mouth;   //!< middle of the mouth
    Vec2 inward;  //!< unit vector from mouth to bottom
};

const Segment& cyclic(const Chain& contour, std::size_t i)
{
    return contour[i % contour.size()];
}

//! The bottom turns to the right all along, so that the gap lies outside the material.
bool is_bottom(const Chain& contour, std::size_t first, std::size_t last)
{
    for (std::size_t i = first; i < last; ++i) {
        const Vec2 t = tangent(cyclic(contour, i), 1);
        const Vec2 u = tangent(cyclic(contour, i + 1), 0);
        if (cyclic(contour, i + 1).bulge > 0 || t.x() * u.y() - t.y() * u.x() > 1e-6) {
            return false;
        }
    }
    return true;
}

double bottom_reach(const Chain& contour, const Slit& slit)
{
    double reach = 0;
    for (std::size_t i = slit.first + 1; i < slit.last; ++i) {
        for (const double f : {0.0, 0.5, 1.0}) {
            reach = std::max(reach, slit.inward.dot(point(cyclic(contour, i), f) - slit.mouth));
        }
    }
    return reach;
}

std::optional<Slit> slit_between(const Chain& contour, std::size_t first, std::size_t last)
{
    const Segment& in = cyclic(contour, first);
    const Segment& out = cyclic(contour, last);
    const Vec2 inward = tangent(in, 0);
    if (is_arc(in) || is_arc(out) || inward.dot(tangent(out, 0)) > -1 + 1e-9 || !is_bottom(contour, first, last)) {
        return std::nullopt;
    }
    const Vec2 across(inward.y(), -inward.x());
    const double width = across.dot(out.a - in.a);
    const double outer = std::max(0.0, inward.dot(out.b - in.a));
    Slit slit{first, last, width, 0, in.a + outer * inward + 0.5 * width * across, inward};
    slit.reach = bottom_reach(contour, slit);
    const double straight = inward.dot(in.b - in.a) - outer;
    return width > 0 && straight > width ? std::optional(slit) : std::nullopt;
}

std::vector<Slit> find_slits(const Chain& contour)
{
    std::vector<Slit> slits;
    for (std::size_t i = 0; i < contour.size(); ++i) {
        for (std::size_t bottom = 1; bottom <= 3 && bottom + 2 < contour.size(); ++bottom) {
            if (const auto slit = slit_between(contour, i, i + bottom + 1)) {
                slits.push_back(*slit);
            }
        }
    }
    return slits;
}

//! How wide the tool cuts, measured across the slit.
double cut_width(const Tool& tool, const Slit& slit)
{
    const Vec2 across(slit.inward.y(), -slit.inward.x());
    return 2 * across.dot(rim_point(tool, across));
}

Expected<std::vector<Slit>> slits_of_one_pass(const Chain& contour, const Tool& tool)
{
    std::vector<Slit> closed;
    for (const Slit& slit : find_slits(contour)) {
        const double left = slit.width - cut_width(tool, slit);
        if (left > 1e-9 && left < narrowest_slit - 1e-9) {
            return refuse("kerf: the slit of " + to_fixed(slit.width, 3) + " mm at " + place(slit.mouth) + " is only " +
                          to_fixed(left, 3) +
                          " mm wider than the kerf: both passes would meet; make the "
                          "slit clearance " +
                          to_fixed(narrowest_slit - left, 3) +
                          " mm larger, or narrower than the kerf so that one pass cuts it");
        }
        if (left <= 1e-9) {
            closed.push_back(slit);
        }
    }
    return closed;
}

//! The contour with the slits bridged straight across their mouths.
Chain without_slits(const Chain& contour, const std::vector<Slit>& slits)
{
    Chain kept = contour;
    std::vector<bool> removed(contour.size(), false);
    for (const Slit& slit : slits) {
        const Vec2 across(slit.inward.y(), -slit.inward.x());
        Segment& in = kept[slit.first];
        Segment& out = kept[slit.last % contour.size()];
        const Vec2 left = slit.mouth - 0.5 * slit.width * across;
        const Vec2 right = slit.mouth + 0.5 * slit.width * across;
        in.b = left;
        out.a = right;
        for (std::size_t i = slit.first + 1; i < slit.last; ++i) {
            removed[i % contour.size()] = true;
        }
        kept[(slit.first + 1) % contour.size()] = {left, right, 0};
        removed[(slit.first + 1) % contour.size()] = false;
    }
    Chain bridged;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (!removed[i] && (kept[i].b - kept[i].a).norm() > 1e-9) {
            bridged.push_back(kept[i]);
        }
    }
    return bridged;
}

//! The pass along a slit: from where the tool path round the contour comes nearest to the mouth, to the bottom.
Path slit_pass(const Slit& slit, const Tool& tool, const Chain& loop)
{
    double nearest = 1e300;
    Vec2 notch = slit.mouth;
    for (const Segment& s : loop) {
        if ((s.a - slit.mouth).norm() < nearest) {
            nearest = (s.a - slit.mouth).norm();
            notch = s.a;
        }
    }
    const double start = std::min(0.0, slit.inward.dot(notch - slit.mouth));
    const double end = slit.reach - slit.inward.dot(rim_point(tool, slit.inward));
    Path pass;
    pass.closed = false;
    pass.vertices = {{slit.mouth + start * slit.inward, 0}, {slit.mouth + end * slit.inward, 0}};
    return pass;
}
//! \}

//! \name What the tool cannot reach
//! \{

double signed_area(const Chain& loop)
{
    return area(closed_path(loop));
}

//! The contour must not lose a gap that is deeper than the kerf is wide.
Expected<void> check_reach(const Chain& contour, const ToolPath& result, const Tool& tool)
{
    Chain passes = segments(result.contour);
    for (const Path& slit : result.slits) {
        const Chain pass = segments(slit);
        passes.insert(passes.end(), pass.begin(), pass.end());
    }
    const double least = 0.5 * std::max(tool.x, tool.y);
    const Tool rounder{std::max(tool.x, least), std::max(tool.y, least)};
    for (const Segment& s : contour) {
        for (const double f : {0.0, 0.25, 0.5, 0.75}) {
            if (tool_distance(rounder, passes, point(s, f)) > 3) {
                return refuse("kerf: the tool cannot enter the gap of the contour at " + place(point(s, f)) +
                              "; widen the gap or use a narrower kerf");
            }
        }
    }
    return {};
}

Expected<Chain> only_loop(const std::vector<Chain>& loops, double sense)
{
    const Chain* only = nullptr;
    for (const Chain& loop : loops) {
        if (std::abs(signed_area(loop)) < 1e-6) {
            continue;
        }
        if (only || signed_area(loop) * sense < 0) {
            return refuse("kerf: it closes a gap of the contour near " + place(loop.front().a) +
                          "; widen the gap or use a narrower kerf");
        }
        only = &loop;
    }
    if (!only) {
        return refuse("kerf: nothing is left of a hole that is narrower than the kerf");
    }
    return *only;
}

Expected<Chain> exact_loop(const Chain& contour, const Tool& tool, double sense)
{
    const auto loops = offset_loops(contour, tool);
    return loops ? only_loop(*loops, sense) : Expected<Chain>(tl::make_unexpected(loops.error()));
}

//! For tools much longer than wide: the loop within #kerf_tolerance, corners cut off where that saves short segments.
Expected<Chain> fitted_loop(const Chain& contour, const Tool& tool, double sense)
{
    Expected<Chain> loop;
    for (const ShortSegments how : {ShortSegments::Kept, ShortSegments::Bridged}) {
        std::vector<Chain> loops;
        for (const auto& points : dense_offset(contour, tool)) {
            loops.push_back(fitted_segments(points, kerf_tolerance, how));
        }
        loop = only_loop(loops, sense);
        if (!loop || is_simple(closed_path(merged_short_segments(*loop)))) {
            return loop;
        }
    }
    return refuse("kerf: the contour cannot be moved by a cut so much wider one way than the other; make the kerfs "
                  "more alike");
}
//! \}

} // namespace

Expected<ToolPath> tool_path(const Path& contour, const Kerf& kerf)
{
    expects(contour.closed && kerf.x >= 0 && kerf.y >= 0, "tool_path: a closed contour and a kerf of 0 or more");
    if (kerf.x == 0 && kerf.y == 0) {
        return ToolPath{contour, {}};
    }
    const Chain nominal = simplified_short_runs(segments(contour));
    const Tool tool = tool_of(kerf);
    const auto slits = slits_of_one_pass(nominal, tool);
    if (!slits) {
        return tl::make_unexpected(slits.error());
    }
    const double sense = signed_area(nominal);
    const Chain bridged = without_slits(nominal, *slits);
    auto loop = exact_loop(bridged, tool, sense);
    if (!is_round(tool) && (!loop || !is_simple(closed_path(merged_short_segments(*loop))))) {
        loop = fitted_loop(bridged, tool, sense);
    }
    if (!loop) {
        return tl::make_unexpected(loop.error());
    }
    ToolPath result{closed_path(merged_short_segments(*loop)), {}};
    for (const Slit& slit : *slits) {
        result.slits.push_back(slit_pass(slit, tool, *loop));
    }
    if (auto ok = check_reach(nominal, result, tool); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return result;
}

} // namespace rhombloom
