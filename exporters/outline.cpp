#include "exporters/outline.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "exporters/segment.h"

namespace rhombloom {

namespace {

using Chain = std::vector<PathVertex>;

const double quarter_bulge = std::tan(pi / 8);

//! A side of the rhomboid: first corner, direction, and outward normal (to the right).
struct SideFrame
{
    Vec2 origin;
    Vec2 along;

    Vec2 to_plane(const Vec2& p) const { return origin + p.x() * along + p.y() * Vec2(along.y(), -along.x()); }
};

Vec2 mirrored_point(const Vec2& p, double length)
{
    return {length - p.x(), p.y()};
}

//! \p half, then its mirror image u -> length - u in reverse order; \p half ends with a straight segment.
Chain with_mirror_image(const Chain& half, double length)
{
    Chain side = half;
    for (std::size_t i = half.size(); i-- > 0;) {
        side.push_back({mirrored_point(half[i].point, length), i > 0 ? half[i - 1].bulge : 0});
    }
    return side;
}

double neck_depth(const HookParameters& p)
{
    return p.neck_setback + p.relief;
}

//! \name The long side
//! \{

double seat_turn(const HookParameters& p)
{
    return std::atan2(p.barb, p.lip - p.lip_rounding);
}

//! Long enough an arc to stay 0.05 mm when a kerf of 0.4 mm is taken off its radius.
double seat_radius(const HookParameters& p)
{
    return std::max(0.3, 0.2 + 0.06 / seat_turn(p));
}

double seat_tangent(const HookParameters& p)
{
    return p.barb > 0 ? seat_radius(p) * std::tan(seat_turn(p) / 2) : 0;
}

void append_seat(Chain& half, const HookParameters& p, double shoulder)
{
    if (p.barb <= 0) {
        return;
    }
    const double turn = seat_turn(p);
    const double k = seat_tangent(p);
    half.push_back({{shoulder, -k}, -std::tan(turn / 4)});
    half.push_back({{shoulder - k * std::sin(turn), k * std::cos(turn)}, 0});
}

Chain long_side(const HookParameters& p)
{
    const double h = neck_depth(p);
    const double shoulder = pivot_radius(p) + p.seat_clearance;
    Chain half = {{{std::sqrt(p.hole_radius * p.hole_radius - h * h), -h}, 0}};
    if (p.relief > 0) {
        half.push_back({{shoulder - p.relief, -h}, -quarter_bulge});
    }
    half.push_back({{shoulder, -p.neck_setback}, 0});
    append_seat(half, p, shoulder);
    half.push_back({{shoulder - p.barb, p.lip - p.lip_rounding}, quarter_bulge});
    half.push_back({{shoulder - p.barb + p.lip_rounding, p.lip}, 0});
    return with_mirror_image(half, p.lb);
}
//! \}

//! \name The short side
//! \{

struct Finger
{
    Vec2 pivot;     //!< cb
    Vec2 direction; //!< d
    Vec2 normal;    //!< n
};

Finger finger(const HookParameters& p)
{
    const double c = std::cos(p.finger_turn);
    const double s = std::sin(p.finger_turn);
    return {{pivot_radius(p) + p.slit / 2, 0}, {c, -s}, {s, c}};
}

Vec2 rim_end(const HookParameters& p)
{
    const Finger f = finger(p);
    return f.pivot - p.slit / 2 * f.normal + (p.finger_length + p.finger_width) * f.direction;
}

Chain hook(const HookParameters& p)
{
    const Finger f = finger(p);
    const Vec2 outer = (p.slit / 2 + p.finger_width) * f.normal;
    const Vec2 inner = p.slit / 2 * f.normal;
    const Vec2 tip = f.pivot + p.finger_length * f.direction;
    return {{{p.hole_radius, 0}, std::tan((pi / 2 + p.finger_turn) / 4)},
            {f.pivot + outer, 0},
            {tip + outer, 1},
            {tip + inner, 0},
            {f.pivot + inner, -1},
            {f.pivot - inner, 0}};
}

struct Cubic
{
    Vec2 a, b, c, d;

    Vec2 point(double t) const
    {
        const double r = 1 - t;
        return r * r * r * a + 3 * r * r * t * b + 3 * r * t * t * c + t * t * t * d;
    }
    Vec2 tangent(double t) const
    {
        const double r = 1 - t;
        return (r * r * (b - a) + 2 * r * t * (c - b) + t * t * (d - c)).normalized();
    }
};

Cubic scoop_cubic(const HookParameters& p)
{
    const Vec2 start = rim_end(p);
    const Vec2 end = mirrored_point(start, p.la);
    const double run = 0.35 * (end.x() - start.x());
    const double depth = (p.scoop_depth + start.y()) / 0.75;
    return {start, start + Vec2(run, -depth), end - Vec2(run, depth), end};
}

Chain scoop(const HookParameters& p)
{
    const Cubic cubic = scoop_cubic(p);
    Chain chain;
    for (int i = 0; i < scoop_biarcs; ++i) {
        const double t = static_cast<double>(i) / scoop_biarcs;
        const double u = static_cast<double>(i + 1) / scoop_biarcs;
        for (const Segment& s : biarc({cubic.point(t), cubic.tangent(t)}, {cubic.point(u), cubic.tangent(u)})) {
            chain.push_back({s.a, -s.bulge}); // the side's frame is left-handed
        }
    }
    return chain;
}

Chain short_side(const HookParameters& p)
{
    const Chain first = hook(p);
    Chain side = first;
    const Chain middle = scoop(p);
    side.insert(side.end(), middle.begin(), middle.end());
    side.push_back({mirrored_point(rim_end(p), p.la), 0});
    const Chain both = with_mirror_image(first, p.la);
    side.insert(side.end(), both.begin() + static_cast<std::ptrdiff_t>(first.size()), both.end());
    return side;
}
//! \}

//! \p chain in the plane; its last vertex starts the arc round the node that has the corner angle \p corner.
void append_side(Path& path, const Chain& chain, const SideFrame& frame, double hole_bulge)
{
    for (const PathVertex& v : chain) {
        path.vertices.push_back({frame.to_plane(v.point), v.bulge});
    }
    path.vertices.back().bulge = hole_bulge;
}

void drop_repeated_vertices(Path& path)
{
    const std::size_t count = path.vertices.size();
    Path kept;
    for (std::size_t i = 0; i < count; ++i) {
        if ((path.vertices[(i + 1) % count].point - path.vertices[i].point).norm() > 1e-9) {
            kept.vertices.push_back(path.vertices[i]);
        }
    }
    path = std::move(kept);
}

struct Need
{
    bool met;
    std::string otherwise;
};

std::string size(double value)
{
    return to_fixed(value, 3) + " mm";
}

//! What the closed forms need; negated comparisons let NaN fail.
Expected<void> check_closed_forms(const HookParameters& p)
{
    const double least = 0.05; // shorter segments are lost in laser programs
    const double seat = seat_tangent(p);
    const double rim = rim_end(p).x();
    const Need needs[] = {
        {p.la > 0 && p.la < 1e4 && p.lb > 0 && p.lb < 1e4, "la and lb must be lengths in mm"},
        {p.alpha > 0 && p.alpha < pi / 2 && p.thickness > 0, "alpha must be acute and the thickness positive"},
        {p.slit > 0 && p.finger_width > 0 && p.hole_radius > 0 && p.finger_length >= 0,
         "slit, finger width and hole radius must be positive, the finger length not negative"},
        {p.neck_setback >= 0 && p.relief >= 0 && p.seat_clearance >= 0 && p.barb >= 0,
         "neck setback, relief, seat clearance and barb cannot be negative"},
        {std::abs(p.finger_turn) < radians(45), "the finger turn must be under 45 degrees"},
        {neck_depth(p) < p.hole_radius * std::sin(p.alpha / 2),
         "neck setback and relief (" + size(neck_depth(p)) + ") reach across the node hole: make them smaller"},
        {p.lip_rounding > 0 && p.lip > p.lip_rounding,
         "lip rounding (" + size(p.lip_rounding) + ") must be positive and under the lip (" + size(p.lip) + ")"},
        {p.relief == 0 || p.relief >= least,
         "the relief (" + size(p.relief) + ") must be 0 or at least " + size(least)},
        {p.barb <= 0 || (seat + least <= p.neck_setback && seat + least <= p.lip - p.lip_rounding),
         "the barb (" + size(p.barb) + ") is too steep to be rounded: make it smaller or the neck setback larger"},
        {p.lb > 2 * (pivot_radius(p) + p.seat_clearance - p.barb + p.lip_rounding),
         "the long side (" + size(p.lb) + ") leaves no straight edge between its hooks: make the finger width smaller"},
        {p.la - 2 * rim > 2, "the hooks of a short side (" + size(p.la) +
                                 ") leave no room for the soft curve between them: make finger width or length "
                                 "smaller"},
        {p.scoop_depth >= -rim_end(p).y(), "the scoop depth (" + size(p.scoop_depth) + ") is less than the rim's (" +
                                               size(-rim_end(p).y()) + "): make it larger"},
    };
    for (const Need& need : needs) {
        if (!need.met) {
            return refuse("hook: " + need.otherwise);
        }
    }
    return {};
}

Path closed_forms(const HookParameters& p)
{
    const Vec2 along_long(1, 0);
    const Vec2 along_short(std::cos(p.alpha), std::sin(p.alpha));
    const double neck_angle = std::asin(neck_depth(p) / p.hole_radius);
    const double obtuse_hole = -std::tan((pi - p.alpha - neck_angle) / 4);
    const double acute_hole = -std::tan((p.alpha - neck_angle) / 4);
    const Chain longer = long_side(p);
    const Chain shorter = short_side(p);
    const Vec2 v1 = p.lb * along_long;
    const Vec2 v3 = p.la * along_short;
    Path path;
    append_side(path, longer, {Vec2::Zero(), along_long}, obtuse_hole);
    append_side(path, shorter, {v1, along_short}, acute_hole);
    append_side(path, longer, {v1 + v3, -along_long}, obtuse_hole);
    append_side(path, shorter, {v3, -along_short}, acute_hole);
    drop_repeated_vertices(path);
    return path;
}

} // namespace

double pivot_radius(const HookParameters& parameters)
{
    return parameters.hole_radius + parameters.finger_width;
}

Expected<Path> element_outline(const HookParameters& parameters)
{
    if (auto ok = check_closed_forms(parameters); !ok) {
        return tl::make_unexpected(ok.error());
    }
    Path outline = closed_forms(parameters);
    if (!is_simple(outline) || area(outline) <= 0) {
        return refuse("hook: the contour crosses itself: make the finger width or the scoop depth smaller, or alpha "
                      "nearer to 65 degrees");
    }
    return outline;
}

Vec2 scoop_point(const HookParameters& parameters, double t)
{
    return scoop_cubic(parameters).point(t);
}

std::vector<Vec2> outline_points(const Path& outline, int segments)
{
    expects(outline.closed && segments >= 8, "outline_points: a closed path and at least 8 segments a circle");
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < outline.vertices.size(); ++i) {
        const PathVertex& v = outline.vertices[i];
        const Vec2 chord = outline.vertices[(i + 1) % outline.vertices.size()].point - v.point;
        const double sweep = 4 * std::atan(v.bulge);
        points.push_back(v.point);
        if (sweep == 0) {
            continue;
        }
        const double by_sweep = std::ceil(segments * std::abs(sweep) / two_pi - 1e-9);
        const int pieces = std::max((segments + 31) / 32, static_cast<int>(by_sweep));
        for (int k = 1; k < pieces; ++k) {
            const double f = static_cast<double>(k) / pieces;
            const double turn = -(1 - f) * sweep / 2;
            const Vec2 turned(std::cos(turn) * chord.x() - std::sin(turn) * chord.y(),
                              std::sin(turn) * chord.x() + std::cos(turn) * chord.y());
            points.push_back(v.point + turned * (std::sin(f * sweep / 2) / std::sin(sweep / 2)));
        }
    }
    return points;
}

Expected<std::vector<Vec2>> outline_points(const HookParameters& parameters, int segments)
{
    auto outline = element_outline(parameters);
    if (!outline) {
        return tl::make_unexpected(outline.error());
    }
    return outline_points(*outline, segments);
}

} // namespace rhombloom
