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

Vec3 highest_vertex(const Surface& surface)
{
    Vec3 highest = surface.point(Vertex(0));
    for (const Vertex v : surface.vertices()) {
        highest = surface.point(v).z() > highest.z() ? Vec3(surface.point(v)) : highest;
    }
    return highest;
}

//! How well a cord holds at \p p, of those that hold toward \p angle: high up, and little aside. 0: not at all.
double hold(const Vec3& centre, double angle, const Vec3& p)
{
    const Vec3 arm = p - centre;
    const double aside = std::remainder(std::atan2(arm.y(), arm.x()) - angle, two_pi);
    return std::abs(aside) < pi / 3 ? std::max(0.0, arm.z()) * std::cos(aside) : 0;
}

std::vector<Vec3> points_round(const Surface& surface, const Vec3& centre)
{
    const Vec3 ahead = highest_vertex(surface);
    const double first = std::atan2(ahead.y() - centre.y(), ahead.x() - centre.x());
    std::vector<Vec3> result;
    for (int k = 0; k < 3; ++k) {
        Vec3 best = ahead;
        double most = 0;
        for (const Vertex v : surface.vertices()) {
            const double holds = hold(centre, first + k * two_pi / 3, surface.point(v));
            best = holds > most ? Vec3(surface.point(v)) : best;
            most = std::max(most, holds);
        }
        if (most > 0) {
            result.push_back(best);
        }
    }
    return result.empty() ? std::vector{ahead} : result;
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
