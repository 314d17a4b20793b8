#include "exporters/bent_element_hooks.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace rhombloom {

namespace {

double smooth_step(double t)
{
    const double x = std::clamp(t, 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

//! The finger belongs wholly to the neighbour's sheet, the root climbs from one to the other, the rim stays.
double neighbour_share(const HookParameters& hooks, double along, double beyond)
{
    const double climb = hooks.finger_width;
    const double pivot = pivot_radius(hooks);
    if (along > pivot + 0.5 * hooks.slit && beyond > 0) {
        return 1;
    }
    const double rise = smooth_step((beyond + climb) / climb);
    const double rim = smooth_step((along - pivot) / climb);
    return rise * (beyond > 0 ? 1 : 1 - rim);
}

std::vector<HookPoint> find_points(const FlatSheet& sheet, const Element& element, const HookParameters& hooks)
{
    const std::array<Vec2, 4> corners = flat_corners(element);
    const double reach = pivot_radius(hooks) + hooks.slit + hooks.finger_length + hooks.finger_width;
    std::vector<HookPoint> found;
    for (int i = 0; i < static_cast<int>(sheet.points.size()); ++i) {
        for (const int side : {1, 3}) {
            const Vec2 origin = corners[side];
            const Vec2 d = (corners[(side + 1) % 4] - origin).normalized();
            const Vec2 r = sheet.points[i] - origin;
            const bool first = r.dot(d) < element.la / 2;
            HookPoint h{i, first ? side : (side + 1) % 4, first ? (side + 1) % 4 : side, 0, 0, 0};
            h.along = first ? r.dot(d) : element.la - r.dot(d);
            h.beyond = r.x() * d.y() - r.y() * d.x();
            h.share = neighbour_share(hooks, h.along, h.beyond);
            if (h.along < reach && h.along > 0 && h.share > 0) {
                found.push_back(h);
            }
        }
    }
    return found;
}

//! The point on the piece that lies \p along from corner \p node on the long side there and \p inside it.
Vec2 beside_long_side(const Element& element, int node, double along, double inside)
{
    constexpr std::array<int, 4> other_end = {1, 0, 3, 2};
    const std::array<Vec2, 4> corners = flat_corners(element);
    const Vec2 inward(0, node < 2 ? 1 : -1);
    return corners[node] + (corners[other_end[node]] - corners[node]).normalized() * along + inward * inside;
}

} // namespace

PatchSamples::PatchSamples(const std::vector<Vec2>& points, const Eigen::Matrix2d& to_unit)
{
    const auto count = static_cast<Eigen::Index>(points.size());
    at.resize(count, BentPatch::controls);
    along.resize(count, BentPatch::controls);
    across.resize(count, BentPatch::controls);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Vec2 uv = to_unit * points[i];
        at.row(i) = patch_basis(uv.x(), uv.y(), 0, 0);
        along.row(i) = patch_basis(uv.x(), uv.y(), 1, 0);
        across.row(i) = patch_basis(uv.x(), uv.y(), 0, 1);
    }
}

Vec3 PatchSamples::normal(const BentPatch& patch, int i, Outward outward) const
{
    const Vec3 u = (along.row(i) * patch.control.transpose()).transpose();
    const Vec3 v = (across.row(i) * patch.control.transpose()).transpose();
    return u.cross(v).normalized() * sign(outward);
}

Hooks find_hooks(const FlatSheet& sheet, const Element& element, const HookParameters& hooks)
{
    Hooks result;
    result.points = find_points(sheet, element, hooks);
    const Eigen::Matrix2d to_unit = rhomboid(element).inverse();
    for (int node = 0; node < 4; ++node) {
        std::vector<Vec2> places;
        for (const HookPoint& h : result.points) {
            places.push_back(beside_long_side(element, node, h.along, h.beyond));
        }
        result.on_neighbour[node] = PatchSamples(places, to_unit);
    }
    return result;
}

} // namespace rhombloom
