#include "exporters/bent_element_bend.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include <Eigen/LU>

namespace rhombloom {

namespace {

constexpr int controls = BentPatch::controls;
constexpr int inner = controls - 4;

using Controls = BentPatch::Controls;
using Vector = SheetMechanics::Vector;
using Matrix = SheetMechanics::Matrix;
using SeatPlaces = std::array<Vec3, 8>;
using ControlMatrix = Eigen::Matrix<double, controls, controls>;

const std::array<int, inner>& inner_controls()
{
    static const std::array<int, inner> list = [] {
        std::array<int, inner> result{};
        int n = 0;
        for (int i = 0; i < controls; ++i) {
            if (std::find(BentPatch::corners.begin(), BentPatch::corners.end(), i) == BentPatch::corners.end()) {
                result[n++] = i;
            }
        }
        return result;
    }();
    return list;
}

Vector inner_part(const Controls& all)
{
    Vector part;
    for (int i = 0; i < inner; ++i) {
        part.segment<3>(3 * i) = all.col(inner_controls()[i]);
    }
    return part;
}

BentPatch stepped(const BentPatch& patch, const Vector& step)
{
    BentPatch next = patch;
    for (int i = 0; i < inner; ++i) {
        next.control.col(inner_controls()[i]) += step.segment<3>(3 * i);
    }
    return next;
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

void add_samples(SheetMechanics& m, const HookParameters& hooks)
{
    const Element& element = m.element;
    const double lip = hooks.lip / (element.la * std::sin(element.alpha));
    const GaussRule us = gauss_rule(11, -0.02, 1.02);
    const GaussRule vs = gauss_rule(8, -lip, 1 + lip);
    const double area = rhomboid(element).determinant();
    const double stiffness = element.thickness * element.thickness / 12;
    m.bending.setZero();
    m.weights.resize(static_cast<int>(us.points.size() * vs.points.size()));
    m.slopes.resize(controls, 2 * m.weights.size());
    int n = 0;
    for (std::size_t i = 0; i < us.points.size(); ++i) {
        for (std::size_t j = 0; j < vs.points.size(); ++j, ++n) {
            const double u = us.points[i];
            const double v = vs.points[j];
            const double cell = us.weights[i] * vs.weights[j] * area;
            Eigen::Matrix<double, controls, 2> slope;
            slope << patch_basis(u, v, 1, 0), patch_basis(u, v, 0, 1);
            m.weights(n) = cell * material(u, v, element, hooks);
            m.slopes.middleCols<2>(2 * n) = slope * m.to_unit;
            m.bending += cell * stiffness * curvature_matrix(u, v, m.to_unit);
        }
    }
}

void add_seats(SheetMechanics& m, const HookParameters& hooks)
{
    constexpr double weight = 0.4; // measured: more stretches the sheet, less opens gaps at the hooks
    const std::array<Vec2, 4> corners = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    for (int k = 0; k < 4; ++k) {
        const double share = pivot_radius(hooks) / (k % 2 == 0 ? m.element.lb : m.element.la);
        for (int end = 0; end < 2; ++end) {
            const Vec2& from = corners[(k + end) % 4];
            const Vec2 uv = from + share * (corners[(k + 1 - end) % 4] - from);
            m.seats[2 * k + end] = {patch_basis(uv.x(), uv.y(), 0, 0), weight};
        }
    }
}

//! \name The energy and its model
//! \{

//! The energy; its gradient by all controls goes to \p gradient.
double energy(const SheetMechanics& m, const BentPatch& patch, const SeatPlaces& places, Controls& gradient)
{
    gradient.noalias() = 2 * patch.control * m.bending;
    double sum = 0.5 * gradient.cwiseProduct(patch.control).sum();
    Eigen::Matrix<double, 3, Eigen::Dynamic> stress = patch.control * m.slopes;
    for (int i = 0; i < m.weights.size(); ++i) {
        const Eigen::Matrix<double, 3, 2> f = stress.middleCols<2>(2 * i);
        const Eigen::Matrix2d strain = 0.5 * (f.transpose() * f - Eigen::Matrix2d::Identity());
        sum += m.weights(i) * strain.squaredNorm();
        stress.middleCols<2>(2 * i) = 2 * m.weights(i) * f * strain;
    }
    gradient.noalias() += stress * m.slopes.transpose();
    for (int k = 0; k < 8; ++k) {
        const Vec3 gap = patch.control * m.seats[k].basis - places[k];
        sum += m.seats[k].weight * gap.squaredNorm();
        gradient.noalias() += 2 * m.seats[k].weight * gap * m.seats[k].basis.transpose();
    }
    return sum;
}

//! The rows of one sample's strain residuals: E_xx, E_yy and sqrt(2) E_xy, by the inner controls.
Eigen::Matrix<double, 3, SheetMechanics::unknowns> strain_rows(const SheetMechanics& m, const BentPatch& patch, int i)
{
    const Eigen::Matrix<double, controls, 2> slope = m.slopes.middleCols<2>(2 * i);
    const Eigen::Matrix<double, 3, 2> f = patch.control * slope;
    Eigen::Matrix<double, 3, SheetMechanics::unknowns> rows;
    for (int k = 0; k < inner; ++k) {
        const double bx = slope(inner_controls()[k], 0);
        const double by = slope(inner_controls()[k], 1);
        rows.block<1, 3>(0, 3 * k) = bx * f.col(0).transpose();
        rows.block<1, 3>(1, 3 * k) = by * f.col(1).transpose();
        rows.block<1, 3>(2, 3 * k) = std::sqrt(0.5) * (bx * f.col(1) + by * f.col(0)).transpose();
    }
    return std::sqrt(m.weights(i)) * rows;
}

//! The part of the second derivative that stress alone gives: the same for each coordinate.
ControlMatrix stress_stiffness(const SheetMechanics& m, const BentPatch& patch)
{
    Eigen::MatrixXd stressed(controls, m.slopes.cols());
    for (int i = 0; i < m.weights.size(); ++i) {
        const Eigen::Matrix<double, controls, 2> slope = m.slopes.middleCols<2>(2 * i);
        const Eigen::Matrix<double, 3, 2> f = patch.control * slope;
        stressed.middleCols<2>(2 * i) = 0.5 * m.weights(i) * slope * (f.transpose() * f - Eigen::Matrix2d::Identity());
    }
    return stressed * m.slopes.transpose();
}

enum class Stress
{
    Ignored,
    Counted
};

//! The energy's second derivative by the inner controls, or its Gauss-Newton part, which is never negative.
Matrix model_matrix(const SheetMechanics& m, const BentPatch& patch, Stress stress)
{
    ControlMatrix stiffness = m.bending;
    if (stress == Stress::Counted) {
        stiffness += stress_stiffness(m, patch);
    }
    for (const Seat& seat : m.seats) {
        stiffness += seat.weight * seat.basis * seat.basis.transpose();
    }
    Eigen::Matrix<double, Eigen::Dynamic, SheetMechanics::unknowns> rows(3 * m.weights.size(),
                                                                         SheetMechanics::unknowns);
    for (int i = 0; i < m.weights.size(); ++i) {
        rows.middleRows<3>(3 * i) = strain_rows(m, patch, i);
    }
    Matrix h = rows.transpose() * rows;
    for (int i = 0; i < inner; ++i) {
        for (int j = 0; j < inner; ++j) {
            const double k = stiffness(inner_controls()[i], inner_controls()[j]);
            h.block<3, 3>(3 * i, 3 * j).diagonal().array() += k;
        }
    }
    return 2 * h;
}

//! Minimise by damped Newton, for the mean element.
BentPatch solve_mean(const SheetMechanics& m, BentPatch patch, const SeatPlaces& places)
{
    Controls gradient;
    double value = energy(m, patch, places, gradient);
    double damping = 1e-3;
    for (int iteration = 0; iteration < 200 && damping < 1e8; ++iteration) {
        Matrix h = model_matrix(m, patch, Stress::Counted);
        h.diagonal() *= 1 + damping;
        Eigen::LLT<Matrix> factor(h);
        if (factor.info() != Eigen::Success) {
            h = model_matrix(m, patch, Stress::Ignored);
            h.diagonal() *= 1 + damping;
            factor.compute(h);
        }
        const Vector step = factor.solve(-inner_part(gradient));
        const BentPatch next = stepped(patch, step);
        Controls next_gradient;
        const double better = energy(m, next, places, next_gradient);
        if (!(better < value)) {
            damping *= 8;
            continue;
        }
        const bool done = value - better < 1e-7 * value;
        patch = next;
        value = better;
        gradient = next_gradient;
        damping /= 8;
        if (done) {
            break;
        }
    }
    return patch;
}

struct Correction
{
    Vector step;
    Vector change;
    double curvature; //!< 1 / step.change
};

//! The L-BFGS direction on top of the factored model.
Vector direction(const SheetMechanics& m, const std::deque<Correction>& memory, Vector q)
{
    std::vector<double> shares(memory.size());
    for (std::size_t k = memory.size(); k-- > 0;) {
        shares[k] = memory[k].curvature * memory[k].step.dot(q);
        q -= shares[k] * memory[k].change;
    }
    Vector r = m.model.solve(q);
    for (std::size_t k = 0; k < memory.size(); ++k) {
        r += memory[k].step * (shares[k] - memory[k].curvature * memory[k].change.dot(r));
    }
    return -r;
}

//! \}

Vec3 bilinear(const std::array<Vec3, 4>& c, double u, double v)
{
    return (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]);
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

//! Where the seats belong: Rp from the node on the straight sides.
SeatPlaces seat_places(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners)
{
    SeatPlaces places;
    for (int k = 0; k < 4; ++k) {
        const Vec3& a = corners[k];
        const Vec3& b = corners[(k + 1) % 4];
        const Vec3 inset = (b - a).normalized() * mechanics.pivot;
        places[2 * k] = a + inset;
        places[2 * k + 1] = b - inset;
    }
    return places;
}

//! \p patch with its offsets from the bilinear patch of its corners carried over to \p corners.
BentPatch carried_over(const BentPatch& patch, const std::array<Vec3, 4>& corners)
{
    std::array<Vec3, 4> shift;
    for (int k = 0; k < 4; ++k) {
        shift[k] = corners[k] - patch.control.col(BentPatch::corners[k]);
    }
    BentPatch moved = patch;
    for (int i = 0; i < controls; ++i) {
        const double u = static_cast<double>(i / (BentPatch::degree_across + 1)) / BentPatch::degree_along;
        const double v = static_cast<double>(i % (BentPatch::degree_across + 1)) / BentPatch::degree_across;
        moved.control.col(i) += bilinear(shift, u, v);
    }
    return moved;
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
    m.mean = solve_mean(m, arched_patch(m, mean), seat_places(m, mean));
    Matrix h = model_matrix(m, m.mean, Stress::Counted);
    m.model.compute(h);
    if (m.model.info() != Eigen::Success) {
        m.model.compute(model_matrix(m, m.mean, Stress::Ignored));
    }
    return m;
}

BentPatch bend(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners)
{
    const SeatPlaces places = seat_places(mechanics, corners);
    constexpr int iterations = 60;
    constexpr std::size_t memory_size = 8;
    BentPatch patch = carried_over(mechanics.mean, corners);
    Controls gradient;
    double value = energy(mechanics, patch, places, gradient);
    std::deque<Correction> memory;
    for (int iteration = 0; iteration < iterations; ++iteration) {
        const Vector g = inner_part(gradient);
        Vector step = direction(mechanics, memory, g);
        const double slope = step.dot(g);
        Controls next_gradient;
        BentPatch next = stepped(patch, step);
        double better = energy(mechanics, next, places, next_gradient);
        for (int half = 0; !(better <= value + 1e-4 * slope) && half < 8; ++half) {
            step *= 0.4;
            next = stepped(patch, step);
            better = energy(mechanics, next, places, next_gradient);
        }
        if (!(better < value)) {
            break;
        }
        const Vector change = inner_part(next_gradient) - g;
        const double curvature = change.dot(step);
        if (curvature > 0) {
            memory.push_back({step, change, 1 / curvature});
        }
        if (memory.size() > memory_size) {
            memory.pop_front();
        }
        const bool done = value - better < 1e-5 * value;
        patch = next;
        value = better;
        gradient = next_gradient;
        if (done) {
            break;
        }
    }
    return patch;
}

} // namespace rhombloom
