#include "exporters/bent_element_bend.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "exporters/bent_element_energy.h"

namespace rhombloom {

namespace {

constexpr int controls = BentPatch::controls;
using ControlMatrix = Eigen::Matrix<double, controls, controls>;

struct GaussRule
{
    std::vector<double> points;
    std::vector<double> weights;
};

//! Gauss-Legendre on [a, b] by Newton's method on the Legendre polynomial.
GaussRule gauss_rule(int n, double a, double b)
{
    GaussRule rule;
    for (int i = 0; i < n; ++i) {
        double x = -std::cos(pi * (i + 0.75) / (n + 0.5));
        double slope = 1;
        for (int iteration = 0; iteration < 20; ++iteration) {
            double p0 = 1;
            double p1 = x;
            for (int k = 2; k <= n; ++k) {
                const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            slope = n * (x * p1 - p0) / (x * x - 1);
            x -= p1 / slope;
        }
        rule.points.push_back(a + (b - a) * (x + 1) / 2);
        rule.weights.push_back((b - a) / ((1 - x * x) * slope * slope));
    }
    return rule;
}

//! Curvature energy of the basis at (u, v): |X_xx|^2 + 2 |X_xy|^2 + |X_yy|^2 as a matrix.
ControlMatrix curvature_matrix(double u, double v, const Eigen::Matrix2d& to_unit)
{
    const BentPatch::Basis uu = patch_basis(u, v, 2, 0);
    const BentPatch::Basis uv = patch_basis(u, v, 1, 1);
    const BentPatch::Basis vv = patch_basis(u, v, 0, 2);
    const auto second = [&](int a, int b) -> BentPatch::Basis {
        const Vec2 p = to_unit.col(a);
        const Vec2 q = to_unit.col(b);
        return p(0) * q(0) * uu + (p(0) * q(1) + p(1) * q(0)) * uv + p(1) * q(1) * vv;
    };
    const BentPatch::Basis xx = second(0, 0);
    const BentPatch::Basis xy = second(0, 1);
    const BentPatch::Basis yy = second(1, 1);
    return xx * xx.transpose() + 2 * xy * xy.transpose() + yy * yy.transpose();
}

//! How much of the sheet there is at (u, v): the holes at the nodes and the scoops of the short sides are missing.
double material(double u, double v, const Element& element, const HookParameters& hooks)
{
    constexpr double nothing = 0.02; // keeps the polynomial tame there
    const Vec2 p = rhomboid(element) * Vec2(u, v);
    for (const Vec2& corner : flat_corners(element)) {
        if ((p - corner).norm() < hooks.hole_radius) {
            return nothing;
        }
    }
    const double from_node = std::min(v, 1 - v) * element.la;
    const double clear = pivot_radius(hooks) + hooks.finger_length + hooks.finger_width;
    const double depth = std::min(u, 1 - u) * element.lb * std::sin(element.alpha);
    return from_node > clear && depth < 0.7 * hooks.scoop_depth ? nothing : 1;
}

//! \brief Half the square of the thickness that counts as bending stiffness, over six, mm2.
//! \details Thin film folds more sharply than the polynomial can: below 1/80 of the side it bends as if it were that
//! thick. Measured: the strain stays the same, and smoother shapes need fewer modes.
double bending_stiffness(const Element& element)
{
    const double t = std::max(element.thickness, element.la / 80);
    return t * t / 12;
}

void add_samples(SheetMechanics& m, const HookParameters& hooks)
{
    constexpr int count = SheetMechanics::samples;
    const Element& element = m.element;
    const double lip = hooks.lip / (element.la * std::sin(element.alpha));
    const GaussRule us = gauss_rule(SheetMechanics::samples_along, -0.02, 1.02);
    const GaussRule vs = gauss_rule(SheetMechanics::samples_across, -lip, 1 + lip);
    const double area = rhomboid(element).determinant();
    const double stiffness = bending_stiffness(element);
    m.bending.setZero();
    m.slopes.resize(2 * count, controls);
    for (int n = 0; n < count; ++n) {
        const int i = n / SheetMechanics::samples_across;
        const int j = n % SheetMechanics::samples_across;
        const double u = us.points[i];
        const double v = vs.points[j];
        const double cell = us.weights[i] * vs.weights[j] * area;
        Eigen::Matrix<double, controls, 2> slope;
        slope << patch_basis(u, v, 1, 0), patch_basis(u, v, 0, 1);
        slope *= m.to_unit;
        m.weights(n) = cell * material(u, v, element, hooks);
        m.slopes.row(n) = slope.col(0);
        m.slopes.row(count + n) = slope.col(1);
        m.bending += cell * stiffness * curvature_matrix(u, v, m.to_unit);
    }
}

void add_seats(SheetMechanics& m, const HookParameters& hooks)
{
    m.seat_weight = 0.1; // measured: more stretches the sheet, less opens gaps at the hooks
    const std::array<Vec2, 4> corners = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    for (int k = 0; k < 4; ++k) {
        const double share = pivot_radius(hooks) / (k % 2 == 0 ? m.element.lb : m.element.la);
        for (int end = 0; end < 2; ++end) {
            const Vec2& from = corners[(k + end) % 4];
            const Vec2 uv = from + share * (corners[(k + 1 - end) % 4] - from);
            m.seats.row(2 * k + end) = patch_basis(uv.x(), uv.y(), 0, 0);
        }
    }
}

//! The bilinear patch with arcs over its long direction, bowed outward: a start for the mean element.
BentPatch arched_patch(const SheetMechanics& m, const std::array<Vec3, 4>& corners)
{
    BentPatch patch;
    patch.to_unit = m.to_unit;
    const double chord = 0.5 * ((corners[1] - corners[0]).norm() + (corners[2] - corners[3]).norm());
    const double bow = 0.75 * chord * std::sqrt(0.375 * std::max(m.element.lb / chord - 1, 1e-4));
    for (int i = 0; i < controls; ++i) {
        const double u = static_cast<double>(i / (BentPatch::degree_across + 1)) / BentPatch::degree_along;
        const double v = static_cast<double>(i % (BentPatch::degree_across + 1)) / BentPatch::degree_across;
        patch.control.col(i) = bilinear(corners, u, v) + 4.6 * bow * u * (1 - u) * Vec3::UnitZ();
    }
    return patch;
}

} // namespace

SheetMechanics sheet_mechanics(const Element& element, const HookParameters& hooks, const std::array<Vec3, 4>& mean)
{
    SheetMechanics m;
    m.element = element;
    m.to_unit = rhomboid(element).inverse();
    add_samples(m, hooks);
    add_seats(m, hooks);
    m.pivot = pivot_radius(hooks);
    m.mean = bend_by_newton(m, arched_patch(m, mean), mean);
    m.model.compute(model_matrix(m, m.mean, Stress::Counted));
    if (m.model.info() != Eigen::Success) {
        m.model.compute(model_matrix(m, m.mean, Stress::Ignored));
    }
    return m;
}

} // namespace rhombloom
