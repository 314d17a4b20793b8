#include "exporters/drawing.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace rhombloom {

namespace {

//! A segment as an arc: centre, radius, start angle and signed sweep. Only for bulge != 0.
struct Arc
{
    Vec2 centre;
    double radius;
    double start;
    double sweep;
};

Arc arc(const Vec2& a, const Vec2& b, double bulge)
{
    const Vec2 chord = b - a;
    const Vec2 normal(-chord.y(), chord.x());
    const Vec2 centre = 0.5 * (a + b) + normal * ((1 - bulge * bulge) / (4 * bulge));
    const Vec2 radial = a - centre;
    return {centre, radial.norm(), std::atan2(radial.y(), radial.x()), 4 * std::atan(bulge)};
}

std::size_t segment_count(const Path& path)
{
    return path.closed ? path.vertices.size() : path.vertices.size() - (path.vertices.empty() ? 0 : 1);
}

const Vec2& segment_end(const Path& path, std::size_t i)
{
    return path.vertices[(i + 1) % path.vertices.size()].point;
}

void grow(Box& box, const Vec2& p)
{
    box.min = box.min.cwiseMin(p);
    box.max = box.max.cwiseMax(p);
}

} // namespace

double area(const Path& path)
{
    double sum = 0;
    for (std::size_t i = 0; i < segment_count(path); ++i) {
        const Vec2& a = path.vertices[i].point;
        const Vec2& b = segment_end(path, i);
        sum += 0.5 * cross_2d(a, b);
        if (path.vertices[i].bulge != 0) {
            const Arc s = arc(a, b, path.vertices[i].bulge);
            sum += 0.5 * s.radius * s.radius * (s.sweep - std::sin(s.sweep));
        }
    }
    return sum;
}

double length(const Path& path)
{
    double sum = 0;
    for (std::size_t i = 0; i < segment_count(path); ++i) {
        const Vec2& a = path.vertices[i].point;
        const Vec2& b = segment_end(path, i);
        const double bulge = path.vertices[i].bulge;
        sum += bulge == 0 ? (b - a).norm() : arc(a, b, bulge).radius * std::abs(4 * std::atan(bulge));
    }
    return sum;
}

Box bounds(const Path& path)
{
    Box box;
    for (const PathVertex& v : path.vertices) {
        grow(box, v.point);
    }
    for (std::size_t i = 0; i < segment_count(path); ++i) {
        if (path.vertices[i].bulge == 0) {
            continue;
        }
        const Arc s = arc(path.vertices[i].point, segment_end(path, i), path.vertices[i].bulge);
        for (int quarter = -4; quarter <= 8; ++quarter) {
            const double angle = quarter * pi / 2;
            const double along = (angle - s.start) / s.sweep;
            if (along > 0 && along < 1) {
                grow(box, s.centre + s.radius * Vec2(std::cos(angle), std::sin(angle)));
            }
        }
    }
    return box;
}

Path placed(const Path& path, double angle, const Vec2& offset)
{
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    Path result = path;
    for (PathVertex& v : result.vertices) {
        v.point = Vec2(c * v.point.x() - s * v.point.y(), s * v.point.x() + c * v.point.y()) + offset;
    }
    return result;
}

Path mirrored(const Path& path)
{
    Path result = path;
    for (PathVertex& v : result.vertices) {
        v.point.x() = -v.point.x();
        v.bulge = -v.bulge;
    }
    return result;
}

std::vector<Vec2> flatten(const Path& path, double tolerance)
{
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < segment_count(path); ++i) {
        points.push_back(path.vertices[i].point);
        if (path.vertices[i].bulge == 0) {
            continue;
        }
        const Arc s = arc(path.vertices[i].point, segment_end(path, i), path.vertices[i].bulge);
        const double step = 2 * std::acos(std::max(0.0, 1 - tolerance / s.radius));
        const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(s.sweep) / step - 1e-9)));
        for (int k = 1; k < pieces; ++k) {
            const double angle = s.start + s.sweep * k / pieces;
            points.push_back(s.centre + s.radius * Vec2(std::cos(angle), std::sin(angle)));
        }
    }
    if (!path.closed && !path.vertices.empty()) {
        points.push_back(path.vertices.back().point);
    }
    return points;
}

} // namespace rhombloom
