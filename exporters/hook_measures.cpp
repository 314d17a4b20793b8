#include "exporters/hook_measures.h"

#include <algorithm>
#include <cmath>

#include <polyclipping/clipper.hpp>

namespace rhombloom {

namespace {

using Points = std::vector<Vec2>;
using ClipperLib::Paths;

constexpr double units = 1e6; // a mm

ClipperLib::IntPoint to_clipper(const Vec2& p)
{
    return {std::llround(p.x() * units), std::llround(p.y() * units)};
}

Vec2 from_clipper(const ClipperLib::IntPoint& p)
{
    return {static_cast<double>(p.X) / units, static_cast<double>(p.Y) / units};
}

ClipperLib::Path to_clipper(const Points& points)
{
    ClipperLib::Path path;
    for (const Vec2& p : points) {
        path.push_back(to_clipper(p));
    }
    return path;
}

Paths intersection(const Paths& a, const Paths& b)
{
    ClipperLib::Clipper clipper;
    clipper.AddPaths(a, ClipperLib::ptSubject, true);
    clipper.AddPaths(b, ClipperLib::ptClip, true);
    Paths result;
    clipper.Execute(ClipperLib::ctIntersection, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    return result;
}

Paths eroded(const Paths& shape, double by)
{
    ClipperLib::ClipperOffset offset(2, 1e-3 * units);
    offset.AddPaths(shape, ClipperLib::jtRound, ClipperLib::etClosedPolygon);
    Paths result;
    offset.Execute(result, -by * units);
    return result;
}

//! A side's first corner and direction.
struct SideFrame
{
    Vec2 origin;
    Vec2 along;
};

Vec2 short_direction(const HookParameters& p)
{
    return {std::cos(p.alpha), std::sin(p.alpha)};
}

//! The sides in order: long v0-v1, short v1-v2, long v2-v3, short v3-v0.
std::vector<SideFrame> sides(const HookParameters& p)
{
    const Vec2 x(1, 0);
    const Vec2 s = short_direction(p);
    return {{Vec2::Zero(), x}, {p.lb * x, s}, {p.lb * x + p.la * s, -x}, {p.la * s, -s}};
}

//! The finger's axis through the slit's bottom, in the frame of its side.
Vec2 finger_direction(const HookParameters& p)
{
    return {std::cos(p.finger_turn), -std::sin(p.finger_turn)};
}

Vec2 tip_centre(const HookParameters& p)
{
    const Vec2 d = finger_direction(p);
    const Vec2 n(-d.y(), d.x());
    return Vec2(pivot_radius(p) + p.slit / 2, 0) + p.finger_length * d + (p.slit + p.finger_width) / 2 * n;
}

Points tip_centres(const HookParameters& p)
{
    const Vec2 tip = tip_centre(p);
    Points tips;
    for (const std::size_t side : {1, 3}) {
        const SideFrame f = sides(p)[side];
        const Vec2 outward(f.along.y(), -f.along.x());
        tips.push_back(f.origin + tip.x() * f.along + tip.y() * outward);
        tips.push_back(f.origin + (p.la - tip.x()) * f.along + tip.y() * outward);
    }
    return tips;
}

bool holds_together(const Paths& shape, double erosion, const Points& tips)
{
    const Paths left = eroded(shape, erosion);
    return left.size() == 1 && std::all_of(tips.begin(), tips.end(), [&](const Vec2& tip) {
               return ClipperLib::PointInPolygon(to_clipper(tip), left.front()) != 0;
           });
}

//! How much of a side, from each node, bowing leaves rigid: hook and lip.
double rigid_end(const HookParameters& p)
{
    return pivot_radius(p) + p.slit / 2 + p.finger_length + p.finger_width;
}

//! \name The interlock
//! \{

//! A piece whose short side v1-v2 lies on the x axis from (la, 0) to the origin, so that it lies below the axis.
Points below_the_edge(const HookParameters& p, const Path& outline)
{
    const Vec2 v2 = sides(p)[2].origin;
    const Vec2 s = short_direction(p);
    Points points = flatten(outline, 0.002);
    for (Vec2& q : points) {
        const Vec2 r = q - v2;
        q = {-s.dot(r), r.x() * s.y() - r.y() * s.x()};
    }
    return points;
}

//! Which sides of the slit's axis an overlap of A and B reaches.
struct Sides
{
    bool finger = false;
    bool rim = false;
};

Sides sides_of_slit(const HookParameters& p, const ClipperLib::Path& overlap)
{
    Sides result;
    const Vec2 pivot(pivot_radius(p) + p.slit / 2, 0);
    const Vec2 d = finger_direction(p);
    for (const auto& vertex : overlap) {
        Vec2 q = from_clipper(vertex);
        q.x() = std::min(q.x(), p.la - q.x());
        const double over = Vec2(-d.y(), d.x()).dot(q - pivot);
        result.finger = result.finger || over > 0.5 * p.slit - 1e-3;
        result.rim = result.rim || over < -0.5 * p.slit + 1e-3;
    }
    return result;
}

Paths moved(const Paths& shape, const Vec2& by)
{
    const ClipperLib::IntPoint d = to_clipper(by);
    Paths result = shape;
    for (auto& path : result) {
        for (auto& q : path) {
            q.X += d.X;
            q.Y += d.Y;
        }
    }
    return result;
}

//! The parts of a shape near both ends of the edge.
Paths near_the_hooks(const HookParameters& p, const Paths& shape)
{
    const double reach = rigid_end(p) + 2;
    const double high = 2 * pivot_radius(p);
    const auto box = [&](double from, double to) {
        return to_clipper(Points{{from, -high}, {to, -high}, {to, high}, {from, high}});
    };
    return intersection(shape, {box(-2, reach), box(p.la - reach, p.la + 2)});
}

bool is_overlap(const ClipperLib::Path& path)
{
    return ClipperLib::Area(path) / units / units > 1e-4;
}

bool is_blocked(const HookParameters& p, const Paths& a, const Paths& b)
{
    for (const auto& overlap : intersection(a, b)) {
        const Sides reached = sides_of_slit(p, overlap);
        if (is_overlap(overlap) && reached.finger && reached.rim) {
            return true;
        }
    }
    return false;
}

//! The first blocked place of a ray of places 0.05 mm apart, refined to 0.003 mm.
double free_travel(const HookParameters& p, const Paths& a, const Paths& b, const Vec2& direction)
{
    constexpr double step = 0.05;
    for (int k = 1; k <= 20; ++k) {
        if (!is_blocked(p, a, moved(b, k * step * direction))) {
            continue;
        }
        double free = (k - 1) * step;
        double blocked = k * step;
        for (int i = 0; i < 4; ++i) {
            const double middle = 0.5 * (free + blocked);
            (is_blocked(p, a, moved(b, middle * direction)) ? blocked : free) = middle;
        }
        return blocked;
    }
    return 1;
}
//! \}

//! One end of a side, seen from its node.
struct SideEnd
{
    SideFrame side;
    double length;
    bool far;
    double depth; //!< mm inside the side's line that still belong to it
};

//! The outline's vertices at one end of a side: x along the side from the node, y outward.
Points end_vertices(const Path& outline, const SideEnd& end, double reach)
{
    Points result;
    for (const PathVertex& v : outline.vertices) {
        const Vec2 r = v.point - end.side.origin;
        Vec2 local(r.dot(end.side.along), r.x() * end.side.along.y() - r.y() * end.side.along.x());
        local.x() = end.far ? end.length - local.x() : local.x();
        if (local.x() > 0 && local.x() < reach && local.y() > -end.depth && local.y() < reach) {
            result.push_back(local);
        }
    }
    return result;
}

double one_sided_distance(const Points& from, const Points& to)
{
    double worst = 0;
    for (const Vec2& p : from) {
        double nearest = 1e300;
        for (const Vec2& q : to) {
            nearest = std::min(nearest, (p - q).norm());
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

} // namespace

double narrowest_web(const HookParameters& parameters, const Path& outline)
{
    const Paths shape = {to_clipper(flatten(outline, 0.001))};
    const Points tips = tip_centres(parameters);
    double holds = 0;
    double breaks = parameters.finger_width / 2;
    while (breaks - holds > 0.0025) {
        const double middle = 0.5 * (holds + breaks);
        (holds_together(shape, middle, tips) ? holds : breaks) = middle;
    }
    return 2 * breaks;
}

std::vector<Vec2> bowed_plan(const HookParameters& parameters, const Path& outline)
{
    const double rigid = rigid_end(parameters);
    const double lost = parameters.lb - parameters.la;
    const double stretch = (parameters.la - 2 * rigid) / (parameters.lb - 2 * rigid);
    Points plan = flatten(outline, 0.002);
    for (Vec2& p : plan) {
        const double u = p.x() - p.y() / std::tan(parameters.alpha);
        if (u > parameters.lb - rigid) {
            p.x() -= lost;
        } else if (u > rigid) {
            p.x() -= (u - rigid) * (1 - stretch);
        }
    }
    return plan;
}

Bow bow(double arc, double chord)
{
    // phi / sin(phi) grows from 1 without bound on (0, pi).
    double low = 0;
    double high = pi;
    for (int i = 0; i < 60; ++i) {
        const double phi = 0.5 * (low + high);
        (phi * chord < arc * std::sin(phi) ? low : high) = phi;
    }
    return {low, arc / (2 * low), 0.5 * chord * std::tan(0.5 * low)};
}

Interlock interlock(const HookParameters& parameters, const Path& outline)
{
    const Paths a = {to_clipper(below_the_edge(parameters, outline))};
    const Paths b = {to_clipper(bowed_plan(parameters, outline))};
    Interlock result;
    for (const auto& overlap : intersection(a, b)) {
        if (is_overlap(overlap)) {
            const Sides reached = sides_of_slit(parameters, overlap);
            result.fingers += reached.finger;
            result.lips += reached.rim;
            result.crossed = result.crossed || (reached.finger && reached.rim);
        }
    }
    const Paths near_a = near_the_hooks(parameters, a);
    const Paths near_b = near_the_hooks(parameters, b);
    for (int degree = 0; degree < 360; degree += 15) {
        const Vec2 direction(std::cos(radians(degree)), std::sin(radians(degree)));
        result.travel.push_back(free_travel(parameters, near_a, near_b, direction));
    }
    return result;
}

double flip_mismatch(const HookParameters& parameters, const Path& outline)
{
    const std::vector<SideFrame> frames = sides(parameters);
    const double reach = rigid_end(parameters) + 0.01;
    const double rim = 0.5 * parameters.slit + reach * std::sin(parameters.finger_turn) + 0.01;
    const double neck = parameters.neck_setback + parameters.relief + 0.01;
    // v1 (obtuse) ends the first long side and begins the first short side; v2 (acute) ends that; v0 is acute.
    const Points obtuse_hook = end_vertices(outline, {frames[1], parameters.la, false, rim}, reach);
    const Points acute_hook = end_vertices(outline, {frames[1], parameters.la, true, rim}, reach);
    const Points obtuse_seat = end_vertices(outline, {frames[0], parameters.lb, true, neck}, reach);
    const Points acute_seat = end_vertices(outline, {frames[0], parameters.lb, false, neck}, reach);
    return std::max({one_sided_distance(obtuse_hook, acute_hook), one_sided_distance(acute_hook, obtuse_hook),
                     one_sided_distance(obtuse_seat, acute_seat), one_sided_distance(acute_seat, obtuse_seat)});
}

} // namespace rhombloom
