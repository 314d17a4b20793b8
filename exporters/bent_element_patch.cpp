#include "exporters/bent_element_patch.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace rhombloom {

namespace {

constexpr int across = BentPatch::degree_across + 1;
constexpr int along = BentPatch::degree_along + 1;
constexpr int controls = BentPatch::controls;
constexpr int inner = controls - 4;

using Basis = Eigen::Matrix<double, controls, 1>;
using ControlMatrix = Eigen::Matrix<double, controls, controls>;
using InnerMatrix = Eigen::Matrix<double, inner, inner>;
using Unknowns = Eigen::Matrix<double, 3 * inner, 1>;
using System = Eigen::Matrix<double, 3 * inner, 3 * inner>;

//! Bernstein polynomials of degree N - 1 at t with their first two derivatives, one column each.
template <int N>
Eigen::Matrix<double, N, 3> bernstein(double t)
{
    Eigen::Matrix<double, N, 3> b = Eigen::Matrix<double, N, 3>::Zero();
    b(0, 0) = 1;
    for (int degree = 1; degree < N; ++degree) {
        // The derivatives of the product rule first: they need the lower degree's values.
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

//! The basis at (u, v) differentiated du times along u and dv times along v.
Basis basis(double u, double v, int du, int dv)
{
    const auto bu = bernstein<along>(u);
    const auto bv = bernstein<across>(v);
    Basis result;
    for (int i = 0; i < along; ++i) {
        for (int j = 0; j < across; ++j) {
            result(i * across + j) = bu(i, du) * bv(j, dv);
        }
    }
    return result;
}

//! The controls of the corners v0..v3.
constexpr std::array<int, 4> corner_control = {0, (along - 1) * across, controls - 1, across - 1};

bool is_corner(int i)
{
    return i == corner_control[0] || i == corner_control[1] || i == corner_control[2] || i == corner_control[3];
}

const std::array<int, inner>& inner_controls()
{
    static const std::array<int, inner> list = [] {
        std::array<int, inner> result{};
        int n = 0;
        for (int i = 0; i < controls; ++i) {
            if (!is_corner(i)) {
                result[n++] = i;
            }
        }
        return result;
    }();
    return list;
}

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

Eigen::Matrix2d rhomboid(const Element& element)
{
    Eigen::Matrix2d sides;
    sides << element.lb, element.la * std::cos(element.alpha), 0, element.la * std::sin(element.alpha);
    return sides;
}

//! Curvature energy of a basis at (u, v): |X_xx|^2 + 2 |X_xy|^2 + |X_yy|^2 as a matrix.
ControlMatrix curvature_matrix(double u, double v, const Eigen::Matrix2d& to_unit)
{
    const Basis uu = basis(u, v, 2, 0);
    const Basis uv = basis(u, v, 1, 1);
    const Basis vv = basis(u, v, 0, 2);
    const auto second = [&](int a, int b) -> Basis {
        const Eigen::Vector2d p = to_unit.col(a);
        const Eigen::Vector2d q = to_unit.col(b);
        return p(0) * q(0) * uu + (p(0) * q(1) + p(1) * q(0)) * uv + p(1) * q(1) * vv;
    };
    const Basis xx = second(0, 0);
    const Basis xy = second(0, 1);
    const Basis yy = second(1, 1);
    return xx * xx.transpose() + 2 * xy * xy.transpose() + yy * yy.transpose();
}

//! How much of the sheet there is at (u, v): the holes at the nodes and the scoops of the short sides are missing.
double material(double u, double v, const Element& element, const HookParameters& hooks)
{
    const Eigen::Matrix2d sides = rhomboid(element);
    const Vec2 p = sides * Vec2(u, v);
    for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
        if ((p - sides * corner).norm() < hooks.hole_radius) {
            return 0.02;
        }
    }
    const double from_node = std::min(v, 1 - v) * element.la;
    const double clear = pivot_radius(hooks) + hooks.finger_length + hooks.finger_width;
    const double depth = std::min(u, 1 - u) * element.lb * std::sin(element.alpha);
    return from_node > clear && depth < 0.7 * hooks.scoop_depth ? 0.02 : 1;
}

//! The frame of a quad of corners: along the long sides, across them, outward.
Eigen::Matrix3d quad_frame(const std::array<Vec3, 4>& c, Outward outward)
{
    const Vec3 x = (c[1] - c[0] + c[2] - c[3]).normalized();
    const Vec3 normal = (c[2] - c[0]).cross(c[3] - c[1]) * static_cast<double>(static_cast<int>(outward));
    const Vec3 n = (normal - normal.dot(x) * x).normalized();
    Eigen::Matrix3d frame;
    frame << x, n.cross(x) * static_cast<double>(static_cast<int>(outward)), n;
    return frame;
}

std::array<Vec3, 4> patch_corners(const BentPatch& patch)
{
    return {patch.control.col(corner_control[0]), patch.control.col(corner_control[1]),
            patch.control.col(corner_control[2]), patch.control.col(corner_control[3])};
}

Vec3 bilinear(const std::array<Vec3, 4>& c, double u, double v)
{
    return (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]);
}

//! \name The energy and its Gauss-Newton model
//! \{

//! Where the four shoulders belong: Rp from their node on the straight side.
std::array<Vec3, 4> seat_targets(const std::array<Vec3, 4>& c, double pivot)
{
    const Vec3 bottom = (c[1] - c[0]).normalized() * pivot;
    const Vec3 top = (c[2] - c[3]).normalized() * pivot;
    return {c[0] + bottom, c[1] - bottom, c[2] - top, c[3] + top};
}

constexpr double seat_weight = 0.5; // mm2 of membrane energy per mm2 of gap

double energy(const SheetMechanics& m, const BentPatch& patch, const std::array<Vec3, 4>& seats)
{
    double sum = (patch.control * m.bending * patch.control.transpose()).trace();
    for (const auto& sample : m.samples) {
        const Eigen::Matrix<double, 3, 2> f = patch.control * sample.slope;
        const Eigen::Matrix2d strain = 0.5 * (f.transpose() * f - Eigen::Matrix2d::Identity());
        sum += sample.weight * strain.squaredNorm();
    }
    for (int k = 0; k < 4; ++k) {
        sum += seat_weight * (patch.control * m.seats[k] - seats[k]).squaredNorm();
    }
    return sum;
}

struct QuadraticModel
{
    System hessian = System::Zero();
    Unknowns gradient = Unknowns::Zero();
};

//! The rows of one sample's strain residuals: E_xx, E_yy and sqrt(2) E_xy, by the inner controls.
void add_sample(const SheetMechanics::Sample& sample, const BentPatch& patch,
                Eigen::Matrix<double, Eigen::Dynamic, 3 * inner>& rows, Eigen::VectorXd& residual, int row)
{
    const Eigen::Matrix<double, 3, 2> f = patch.control * sample.slope;
    const double root = std::sqrt(sample.weight);
    const double shear = root * std::sqrt(0.5);
    for (int i = 0; i < inner; ++i) {
        const double bx = sample.slope(inner_controls()[i], 0);
        const double by = sample.slope(inner_controls()[i], 1);
        rows.template block<1, 3>(row, 3 * i) = root * bx * f.col(0).transpose();
        rows.template block<1, 3>(row + 1, 3 * i) = root * by * f.col(1).transpose();
        rows.template block<1, 3>(row + 2, 3 * i) = shear * (bx * f.col(1) + by * f.col(0)).transpose();
    }
    residual(row) = root * 0.5 * (f.col(0).squaredNorm() - 1);
    residual(row + 1) = root * 0.5 * (f.col(1).squaredNorm() - 1);
    residual(row + 2) = shear * f.col(0).dot(f.col(1));
}

//! Add the quadratic terms (bending, seats), whose matrices act on each coordinate alike.
void add_quadratic(const SheetMechanics& m, const BentPatch& patch, const std::array<Vec3, 4>& seats,
                   QuadraticModel& model)
{
    ControlMatrix stiffness = m.bending;
    Eigen::Matrix<double, 3, controls> force = patch.control * m.bending;
    for (int k = 0; k < 4; ++k) {
        stiffness += seat_weight * m.seats[k] * m.seats[k].transpose();
        force += seat_weight * (patch.control * m.seats[k] - seats[k]) * m.seats[k].transpose();
    }
    for (int i = 0; i < inner; ++i) {
        model.gradient.template segment<3>(3 * i) += force.col(inner_controls()[i]);
        for (int j = 0; j < inner; ++j) {
            const double k = stiffness(inner_controls()[i], inner_controls()[j]);
            model.hessian.template block<3, 3>(3 * i, 3 * j).diagonal().array() += k;
        }
    }
}

QuadraticModel quadratic_model(const SheetMechanics& m, const BentPatch& patch, const std::array<Vec3, 4>& seats)
{
    Eigen::Matrix<double, Eigen::Dynamic, 3 * inner> rows(3 * m.samples.size(), 3 * inner);
    Eigen::VectorXd residual(3 * m.samples.size());
    for (std::size_t i = 0; i < m.samples.size(); ++i) {
        add_sample(m.samples[i], patch, rows, residual, static_cast<int>(3 * i));
    }
    QuadraticModel model;
    model.hessian.template triangularView<Eigen::Lower>() = rows.transpose() * rows;
    model.hessian = model.hessian.template selfadjointView<Eigen::Lower>();
    model.gradient = rows.transpose() * residual;
    add_quadratic(m, patch, seats, model);
    return model;
}

BentPatch stepped(const BentPatch& patch, const Unknowns& step)
{
    BentPatch next = patch;
    for (int i = 0; i < inner; ++i) {
        next.control.col(inner_controls()[i]) += step.template segment<3>(3 * i);
    }
    return next;
}

//! \}

} // namespace

Vec3 bent_position(const BentPatch& patch, const Vec2& p)
{
    const Vec2 uv = patch.to_unit * p;
    return patch.control * basis(uv.x(), uv.y(), 0, 0);
}

Vec3 bent_normal(const BentPatch& patch, const Vec2& p, Outward outward)
{
    const Vec2 uv = patch.to_unit * p;
    const Vec3 u = patch.control * basis(uv.x(), uv.y(), 1, 0);
    const Vec3 v = patch.control * basis(uv.x(), uv.y(), 0, 1);
    return u.cross(v).normalized() * static_cast<double>(static_cast<int>(outward));
}

SheetMechanics sheet_mechanics(const Element& element, const HookParameters& hooks)
{
    SheetMechanics m;
    m.element = element;
    m.to_unit = rhomboid(element).inverse();
    m.bending.setZero();
    const double lip = hooks.lip / (element.la * std::sin(element.alpha));
    const GaussRule us = gauss_rule(10, -0.02, 1.02);
    const GaussRule vs = gauss_rule(7, -lip, 1 + lip);
    const double area = rhomboid(element).determinant();
    const double stiffness = element.thickness * element.thickness / 12;
    for (std::size_t i = 0; i < us.points.size(); ++i) {
        for (std::size_t j = 0; j < vs.points.size(); ++j) {
            const double u = us.points[i];
            const double v = vs.points[j];
            SheetMechanics::Sample sample;
            sample.weight = us.weights[i] * vs.weights[j] * area * material(u, v, element, hooks);
            sample.slope << basis(u, v, 1, 0), basis(u, v, 0, 1);
            sample.slope = (sample.slope * m.to_unit).eval();
            m.samples.push_back(sample);
            m.bending += us.weights[i] * vs.weights[j] * area * stiffness * curvature_matrix(u, v, m.to_unit);
        }
    }
    m.pivot = pivot_radius(hooks);
    const double seat = m.pivot / element.lb;
    m.seats = {basis(seat, 0, 0, 0), basis(1 - seat, 0, 0, 0), basis(1 - seat, 1, 0, 0), basis(seat, 1, 0, 0)};
    return m;
}

BentPatch arched_patch(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners, Outward outward)
{
    BentPatch patch;
    patch.to_unit = mechanics.to_unit;
    const Vec3 n = quad_frame(corners, outward).col(2);
    const double chord = 0.5 * ((corners[1] - corners[0]).norm() + (corners[2] - corners[3]).norm());
    const double excess = std::max(mechanics.element.lb / chord - 1, 1e-4);
    const double bow = 0.75 * chord * std::sqrt(0.375 * excess);
    for (int i = 0; i < along; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = static_cast<double>(i) / (along - 1);
            const double v = static_cast<double>(j) / (across - 1);
            patch.control.col(i * across + j) = bilinear(corners, u, v) + 4.6 * bow * u * (1 - u) * n;
        }
    }
    return patch;
}

BentPatch transferred(const BentPatch& patch, Outward from, const std::array<Vec3, 4>& corners, Outward outward)
{
    const std::array<Vec3, 4> old = patch_corners(patch);
    const Eigen::Matrix3d turn = quad_frame(corners, outward) * quad_frame(old, from).transpose();
    BentPatch moved = patch;
    for (int i = 0; i < along; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = static_cast<double>(i) / (along - 1);
            const double v = static_cast<double>(j) / (across - 1);
            const Vec3 offset = patch.control.col(i * across + j) - bilinear(old, u, v);
            moved.control.col(i * across + j) = bilinear(corners, u, v) + turn * offset;
        }
    }
    return moved;
}

BentPatch bend(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners, const BentPatch& start)
{
    BentPatch patch = start;
    for (int k = 0; k < 4; ++k) {
        patch.control.col(corner_control[k]) = corners[k];
    }
    const std::array<Vec3, 4> seats = seat_targets(corners, mechanics.pivot);
    double value = energy(mechanics, patch, seats);
    double damping = 1e-4;
    for (int iteration = 0; iteration < 60 && damping < 1e6; ++iteration) {
        const QuadraticModel model = quadratic_model(mechanics, patch, seats);
        System h = model.hessian;
        h.diagonal() *= 1 + damping;
        const Unknowns step = h.ldlt().solve(-model.gradient);
        const BentPatch next = stepped(patch, step);
        const double better = energy(mechanics, next, seats);
        if (!(better < value)) {
            damping *= 10;
            continue;
        }
        const double gain = value - better;
        patch = next;
        value = better;
        damping = std::max(1e-9, damping / 10);
        if (gain < 1e-9 * value || step.cwiseAbs().maxCoeff() < 1e-3) {
            break;
        }
    }
    return patch;
}

} // namespace rhombloom
