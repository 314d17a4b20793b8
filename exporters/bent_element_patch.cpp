#include "exporters/bent_element_patch.h"

#include <cmath>

#include <Eigen/Geometry>

namespace rhombloom {

namespace {

//! Bernstein polynomials of degree N - 1 at t with their first two derivatives, one column each.
template <int N>
Eigen::Matrix<double, N, 3> bernstein(double t)
{
    Eigen::Matrix<double, N, 3> b = Eigen::Matrix<double, N, 3>::Zero();
    b(0, 0) = 1;
    for (int degree = 1; degree < N; ++degree) {
        // From the top, because row i needs row i - 1 of the lower degree.
        for (int i = degree; i >= 0; --i) {
            const Eigen::RowVector3d left = i > 0 ? b.row(i - 1).eval() : Eigen::RowVector3d::Zero();
            const Eigen::RowVector3d here = i < degree ? b.row(i).eval() : Eigen::RowVector3d::Zero();
            b(i, 2) = t * left(2) + 2 * left(1) + (1 - t) * here(2) - 2 * here(1);
            b(i, 1) = t * left(1) + left(0) + (1 - t) * here(1) - here(0);
            b(i, 0) = t * left(0) + (1 - t) * here(0);
        }
    }
    return b;
}

} // namespace

BentPatch::Basis patch_basis(double u, double v, int du, int dv)
{
    constexpr int across = BentPatch::degree_across + 1;
    const auto bu = bernstein<BentPatch::degree_along + 1>(u);
    const auto bv = bernstein<across>(v);
    BentPatch::Basis result;
    for (int i = 0; i <= BentPatch::degree_along; ++i) {
        for (int j = 0; j < across; ++j) {
            result(i * across + j) = bu(i, du) * bv(j, dv);
        }
    }
    return result;
}

Eigen::Matrix2d rhomboid(const Element& element)
{
    Eigen::Matrix2d sides;
    sides << element.lb, element.la * std::cos(element.alpha), 0, element.la * std::sin(element.alpha);
    return sides;
}

std::array<Vec2, 4> flat_corners(const Element& element)
{
    const Eigen::Matrix2d sides = rhomboid(element);
    return {Vec2(0, 0), sides.col(0), sides.col(0) + sides.col(1), sides.col(1)};
}

Vec3 bent_position(const BentPatch& patch, const Vec2& p)
{
    const Vec2 uv = patch.to_unit * p;
    return patch.control * patch_basis(uv.x(), uv.y(), 0, 0);
}

Vec3 bent_normal(const BentPatch& patch, const Vec2& p, Outward outward)
{
    const Vec2 uv = patch.to_unit * p;
    const Vec3 u = patch.control * patch_basis(uv.x(), uv.y(), 1, 0);
    const Vec3 v = patch.control * patch_basis(uv.x(), uv.y(), 0, 1);
    return u.cross(v).normalized() * sign(outward);
}

} // namespace rhombloom
