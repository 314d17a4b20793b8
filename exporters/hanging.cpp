#include "exporters/hanging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/building/viewpoints.h"
#include "core/units.h"

namespace rhombloom {

namespace {

//! Where the plane of a triangle is at (x, y), or nothing beside it.
std::optional<double> height_at(const std::array<Vec3, 3>& t, const Vec3& at)
{
    const auto turn = [](const Vec3& a, const Vec3& b, const Vec3& c) {
        return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    };
    const double area = turn(t[0], t[1], t[2]);
    const double u = turn(at, t[1], t[2]) / area;
    const double v = turn(t[0], at, t[2]) / area;
    const bool inside = area != 0 && u >= 0 && v >= 0 && u + v <= 1;
    return inside ? std::optional(u * t[0].z() + v * t[1].z() + (1 - u - v) * t[2].z()) : std::nullopt;
}

//! The highest point above or below \p at.
std::optional<double> highest_at(const Surface& surface, const Vec3& at)
{
    std::optional<double> top;
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        const auto corner = [&](int k) -> Vec3 { return surface.point(Vertex(q[k])); };
        for (const auto& t :
             {std::array{corner(0), corner(1), corner(2)}, std::array{corner(0), corner(2), corner(3)}}) {
            const std::optional<double> z = height_at(t, at);
            top = z && (!top || *z > *top) ? z : top;
        }
    }
    return top;
}

std::vector<Vec3> vertices_from_the_top(const Surface& surface)
{
    std::vector<Vec3> points;
    for (const Vertex v : surface.vertices()) {
        points.push_back(surface.point(v));
    }
    std::stable_sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.z() > b.z(); });
    return points;
}

//! The third of the circle round \p centre that \p p lies in; the first lies about \p ahead.
int third(const Vec3& centre, const Vec3& ahead, const Vec3& p)
{
    const auto angle = [&](const Vec3& q) { return std::atan2(q.y() - centre.y(), q.x() - centre.x()); };
    const double turned = angle(p) - angle(ahead) + pi / 3;
    return static_cast<int>(std::floor((turned - two_pi * std::floor(turned / two_pi)) / (two_pi / 3))) % 3;
}

std::vector<Vec3> points_round(const Surface& surface, const Vec3& centre)
{
    const std::vector<Vec3> points = vertices_from_the_top(surface);
    std::array<std::optional<Vec3>, 3> highest;
    for (const Vec3& p : points) {
        std::optional<Vec3>& found = highest[third(centre, points.front(), p)];
        found = found ? found : p;
    }
    std::vector<Vec3> result;
    for (const auto& p : highest) {
        if (p && p->z() >= centre.z()) {
            result.push_back(*p);
        }
    }
    return result;
}

} // namespace

Vec3 mass_centre(const Surface& surface)
{
    Vec3 centre = Vec3::Zero();
    for (const Face f : surface.faces()) {
        centre += element_centre(surface, f) / static_cast<double>(surface.n_faces());
    }
    return centre;
}

std::vector<Vec3> hanging_points(const Surface& surface)
{
    const Vec3 centre = mass_centre(surface);
    const std::optional<double> top = highest_at(surface, centre);
    if (top && *top > centre.z()) {
        return {Vec3(centre.x(), centre.y(), *top)};
    }
    return points_round(surface, centre);
}

} // namespace rhombloom
