#include "exporters/segment.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace rhombloom {

namespace {

Vec2 turned(const Vec2& v, double angle)
{
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

std::vector<Vec2> line_line(const Segment& s, const Segment& t)
{
    const Vec2 u = s.b - s.a;
    const Vec2 v = t.b - t.a;
    const double det = cross_2d(u, v);
    if (std::abs(det) < 1e-12 * u.norm() * v.norm()) {
        return {};
    }
    return {s.a + u * (cross_2d(t.a - s.a, v) / det)};
}

std::vector<Vec2> line_circle(const Segment& line, const Circle& c)
{
    const Vec2 along = (line.b - line.a).normalized();
    const Vec2 foot = line.a + along * along.dot(c.centre - line.a);
    const double square = c.radius * c.radius - (c.centre - foot).squaredNorm();
    if (square < 0) {
        return {};
    }
    const double half = std::sqrt(square);
    return {foot - half * along, foot + half * along};
}

std::vector<Vec2> circle_circle(const Circle& c, const Circle& e)
{
    const Vec2 apart = e.centre - c.centre;
    const double distance = apart.norm();
    if (distance < 1e-12) {
        return {};
    }
    const Vec2 u = apart / distance;
    const double along = (distance * distance + c.radius * c.radius - e.radius * e.radius) / (2 * distance);
    const double square = c.radius * c.radius - along * along;
    if (square < 0) {
        return {};
    }
    const Vec2 foot = c.centre + along * u;
    const Vec2 side = std::sqrt(square) * Vec2(-u.y(), u.x());
    return {foot - side, foot + side};
}

//! The angle from one radius to another in the sense of \p sense, as close as possible to \p near.
double angle_between(const Vec2& from, const Vec2& to, double near)
{
    const double angle = std::atan2(cross_2d(from, to), from.dot(to));
    return angle + two_pi * std::round((near - angle) / two_pi);
}

//! How far, in mm, rounding may move the crossing of two segments that are tangent at their common end.
constexpr double tangent_slack = 1e-5;

//! An arc of at most a half circle lies in the circle over its chord; so do all of a path's segments.
bool far_apart(const Segment& s, const Segment& t)
{
    const double reach = 0.5 * ((s.b - s.a).norm() + (t.b - t.a).norm()) + 1e-6;
    return (0.5 * (s.a + s.b) - 0.5 * (t.a + t.b)).squaredNorm() > reach * reach;
}

bool touch_at_common_end_only(const Segment& s, const Segment& t)
{
    if (tangent(s, 1).dot(tangent(t, 0)) < -1 + 1e-12 && is_arc(s) == is_arc(t)) {
        return false; // turns back on itself
    }
    const auto places = crossings(s, t);
    return std::all_of(places.begin(), places.end(), [&](const std::pair<double, double>& at) {
        return (1 - at.first) * length(s) < tangent_slack && at.second * length(t) < tangent_slack;
    });
}

bool apart(const Segment& s, const Segment& t)
{
    if (far_apart(s, t)) {
        return true;
    }
    const bool ends_apart = distance(s, t.a) > 1e-9 && distance(s, t.b) > 1e-9 && distance(t, s.a) > 1e-9;
    return ends_apart && crossings(s, t).empty();
}

} // namespace

bool is_arc(const Segment& segment)
{
    return std::abs(segment.bulge) > 2e-9;
}

double sweep(const Segment& segment)
{
    return is_arc(segment) ? 4 * std::atan(segment.bulge) : 0;
}

Circle circle(const Segment& segment)
{
    const Vec2 chord = segment.b - segment.a;
    const double b = segment.bulge;
    const Vec2 centre = 0.5 * (segment.a + segment.b) + Vec2(-chord.y(), chord.x()) * ((1 - b * b) / (4 * b));
    return {centre, chord.norm() * (1 + b * b) / (4 * std::abs(b))};
}

double length(const Segment& segment)
{
    const double chord = (segment.b - segment.a).norm();
    const double phi = std::abs(sweep(segment));
    return phi > 0 ? chord * phi / (2 * std::sin(phi / 2)) : chord;
}

Vec2 point(const Segment& segment, double f)
{
    const Vec2 chord = segment.b - segment.a;
    const double phi = sweep(segment);
    if (phi == 0) {
        return segment.a + f * chord;
    }
    return segment.a + turned(chord, -(1 - f) * phi / 2) * (std::sin(f * phi / 2) / std::sin(phi / 2));
}

Vec2 tangent(const Segment& segment, double f)
{
    return turned((segment.b - segment.a).normalized(), (f - 0.5) * sweep(segment));
}

double fraction(const Segment& segment, const Vec2& p)
{
    if (!is_arc(segment)) {
        const Vec2 chord = segment.b - segment.a;
        return chord.dot(p - segment.a) / chord.squaredNorm();
    }
    const Vec2 centre = circle(segment).centre;
    const double phi = sweep(segment);
    return angle_between(segment.a - centre, p - centre, phi / 2) / phi;
}

double distance(const Segment& segment, const Vec2& p)
{
    const double f = std::clamp(fraction(segment, p), 0.0, 1.0);
    if (is_arc(segment) && f > 0 && f < 1) {
        const Circle c = circle(segment);
        return std::abs((p - c.centre).norm() - c.radius);
    }
    return (p - point(segment, f)).norm();
}

Segment part(const Segment& segment, double from, double to)
{
    const Vec2 a = from == 0 ? segment.a : point(segment, from);
    const Vec2 b = to == 1 ? segment.b : point(segment, to);
    return {a, b, is_arc(segment) ? std::tan(sweep(segment) * (to - from) / 4) : 0};
}

Segment ending_at(const Segment& segment, const Vec2& p)
{
    Segment result{segment.a, p, 0};
    if (is_arc(segment)) {
        const Vec2 centre = circle(segment).centre;
        result.bulge = std::tan(angle_between(segment.a - centre, p - centre, sweep(segment)) / 4);
    }
    return result;
}

Segment starting_at(const Segment& segment, const Vec2& p)
{
    const Segment backwards = ending_at({segment.b, segment.a, -segment.bulge}, p);
    return {p, segment.b, -backwards.bulge};
}

std::vector<Vec2> carrier_crossings(const Segment& s, const Segment& t)
{
    if (is_arc(s)) {
        return is_arc(t) ? circle_circle(circle(s), circle(t)) : line_circle(t, circle(s));
    }
    return is_arc(t) ? line_circle(s, circle(t)) : line_line(s, t);
}

std::vector<std::pair<double, double>> crossings(const Segment& s, const Segment& t)
{
    if (far_apart(s, t)) {
        return {};
    }
    const double slack_s = 1e-9 / length(s);
    const double slack_t = 1e-9 / length(t);
    std::vector<std::pair<double, double>> result;
    for (const Vec2& p : carrier_crossings(s, t)) {
        const double f = fraction(s, p);
        const double g = fraction(t, p);
        if (f >= -slack_s && f <= 1 + slack_s && g >= -slack_t && g <= 1 + slack_t) {
            result.emplace_back(std::clamp(f, 0.0, 1.0), std::clamp(g, 0.0, 1.0));
        }
    }
    return result;
}

std::array<Segment, 2> biarc(const Heading& from, const Heading& to)
{
    const auto bulge = [](const Vec2& t, const Vec2& chord) {
        return cross_2d(t, chord) / (chord.norm() + t.dot(chord));
    };
    const Vec2 v = to.point - from.point;
    const Vec2 both = from.tangent + to.tangent;
    const double x = v.dot(both);
    const double bend = 2 * (1 - from.tangent.dot(to.tangent));
    const double reach = v.squaredNorm() / (x + std::sqrt(x * x + bend * v.squaredNorm()));
    const Vec2 middle = 0.5 * (from.point + reach * from.tangent + to.point - reach * to.tangent);
    const Vec2 between = (v - reach * both).normalized();
    return {Segment{from.point, middle, bulge(from.tangent, middle - from.point)},
            Segment{middle, to.point, bulge(between, to.point - middle)}};
}

std::vector<Segment> segments(const Path& path)
{
    std::vector<Segment> result;
    const std::size_t count = path.vertices.size();
    for (std::size_t i = 0; i + (path.closed ? 0 : 1) < count; ++i) {
        const Segment s{path.vertices[i].point, path.vertices[(i + 1) % count].point, path.vertices[i].bulge};
        if ((s.b - s.a).norm() > 1e-9) {
            result.push_back(s);
        }
    }
    return result;
}

Path closed_path(const std::vector<Segment>& segments)
{
    Path path;
    for (const Segment& s : segments) {
        path.vertices.push_back({s.a, s.bulge});
    }
    return path;
}

bool is_simple(const Path& path)
{
    const std::vector<Segment> all = segments(path);
    const std::size_t n = all.size();
    if (n < 3) {
        return n == 2 && is_arc(all[0]) && is_arc(all[1]);
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (!touch_at_common_end_only(all[i], all[(i + 1) % n])) {
            return false;
        }
        for (std::size_t j = i + 2; j < n && !(i == 0 && j == n - 1); ++j) {
            if (!apart(all[i], all[j])) {
                return false;
            }
        }
    }
    return true;
}

} // namespace rhombloom
