#include "exporters/bent_element_energy.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace rhombloom {

namespace {

constexpr int controls = BentPatch::controls;
constexpr int inner = controls - 4;
constexpr int samples = SheetMechanics::samples;

using Vector = SheetMechanics::Vector;
using Matrix = SheetMechanics::Matrix;
using ControlMatrix = Eigen::Matrix<double, controls, controls>;
//! One row per control: a matrix product with three columns is faster than one with three rows.
using ControlRows = Eigen::Matrix<double, controls, 3>;
using SampleRows = Eigen::Matrix<double, 2 * samples, 3>;

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

//! Strain of sample \p i from its slopes: E_xx, E_yy and E_xy.
Vec3 strain(const SampleRows& f, int i)
{
    const auto x = f.row(i);
    const auto y = f.row(samples + i);
    return {0.5 * (x.squaredNorm() - 1), 0.5 * (y.squaredNorm() - 1), 0.5 * x.dot(y)};
}

//! The rows of one sample's strain residuals: E_xx, E_yy and sqrt(2) E_xy, by the inner controls.
Eigen::Matrix<double, 3, SheetMechanics::unknowns> strain_rows(const SheetMechanics& m, const SampleRows& f, int i)
{
    const Eigen::RowVector3d fx = f.row(i);
    const Eigen::RowVector3d fy = f.row(samples + i);
    Eigen::Matrix<double, 3, SheetMechanics::unknowns> rows;
    for (int k = 0; k < inner; ++k) {
        const double bx = m.slopes(i, inner_controls()[k]);
        const double by = m.slopes(samples + i, inner_controls()[k]);
        rows.block<1, 3>(0, 3 * k) = bx * fx;
        rows.block<1, 3>(1, 3 * k) = by * fy;
        rows.block<1, 3>(2, 3 * k) = std::sqrt(0.5) * (bx * fy + by * fx);
    }
    return std::sqrt(m.weights(i)) * rows;
}

//! The part of the second derivative that stress alone gives: the same for each coordinate.
ControlMatrix stress_stiffness(const SheetMechanics& m, const SampleRows& f)
{
    Eigen::MatrixXd stressed(2 * samples, controls);
    for (int i = 0; i < samples; ++i) {
        const Vec3 e = m.weights(i) * strain(f, i);
        stressed.row(i) = e(0) * m.slopes.row(i) + e(2) * m.slopes.row(samples + i);
        stressed.row(samples + i) = e(2) * m.slopes.row(i) + e(1) * m.slopes.row(samples + i);
    }
    return m.slopes.transpose() * stressed;
}

} // namespace

SeatPlaces seat_places(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners)
{
    SeatPlaces places;
    for (int k = 0; k < 4; ++k) {
        const Vec3& a = corners[k];
        const Vec3& b = corners[(k + 1) % 4];
        const Vec3 inset = (b - a).normalized() * mechanics.pivot;
        places.row(2 * k) = a + inset;
        places.row(2 * k + 1) = b - inset;
    }
    return places;
}

double sheet_energy(const SheetMechanics& m, const BentPatch& patch, const SeatPlaces& places, Vector& gradient)
{
    const ControlRows control = patch.control.transpose();
    ControlRows slope;
    slope.noalias() = m.bending * control;
    double sum = slope.cwiseProduct(control).sum();
    SampleRows stress;
    stress.noalias() = m.slopes * control;
    for (int i = 0; i < samples; ++i) {
        const Vec3 e = strain(stress, i);
        sum += m.weights(i) * (e(0) * e(0) + e(1) * e(1) + 2 * e(2) * e(2));
        const Eigen::RowVector3d x = stress.row(i);
        const Eigen::RowVector3d y = stress.row(samples + i);
        stress.row(i) = m.weights(i) * (e(0) * x + e(2) * y);
        stress.row(samples + i) = m.weights(i) * (e(2) * x + e(1) * y);
    }
    slope.noalias() += m.slopes.transpose() * stress;
    const SeatPlaces gaps = m.seats * control - places;
    sum += m.seat_weight * gaps.squaredNorm();
    slope.noalias() += m.seat_weight * m.seats.transpose() * gaps;
    for (int i = 0; i < inner; ++i) {
        gradient.segment<3>(3 * i) = 2 * slope.row(inner_controls()[i]);
    }
    return sum;
}

Matrix model_matrix(const SheetMechanics& m, const BentPatch& patch, Stress stress)
{
    const SampleRows f = m.slopes * patch.control.transpose();
    ControlMatrix stiffness = m.bending + m.seat_weight * m.seats.transpose() * m.seats;
    if (stress == Stress::Counted) {
        stiffness += stress_stiffness(m, f);
    }
    Eigen::Matrix<double, Eigen::Dynamic, SheetMechanics::unknowns> rows(3 * samples, SheetMechanics::unknowns);
    for (int i = 0; i < samples; ++i) {
        rows.middleRows<3>(3 * i) = strain_rows(m, f, i);
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

BentPatch stepped(const BentPatch& patch, const Vector& step)
{
    BentPatch next = patch;
    for (int i = 0; i < inner; ++i) {
        next.control.col(inner_controls()[i]) += step.segment<3>(3 * i);
    }
    return next;
}

Vec3 bilinear(const std::array<Vec3, 4>& c, double u, double v)
{
    return (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]);
}

} // namespace rhombloom
