#include "core/form/concavity_energy.h"

#include <Eigen/Geometry>

#include "core/form/term_kernels.h"
#include "core/units.h"

namespace rhombloom {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// One triangle over the edge, in the edge's frame.
struct Wing
{
    std::array<double, 3> weight; // d(foot-free part)/d(x0, x1, apex): -(1 - s), -s, 1 for foot parameter s
    Vector3d across;              // unit, in the plane, from the edge to the apex
    Vector3d normal;              // along x across
    double height;
};

constexpr std::array<double, 3> edge_weight = {-1, 1, 0};

Wing make_wing(const Vector3d& x0, const Vector3d& along, double length, const Vector3d& apex)
{
    const Vector3d r = apex - x0;
    const double s = r.dot(along) / length;
    const Vector3d up = r - s * length * along;
    Wing wing;
    wing.weight = {-(1 - s), -s, 1};
    wing.height = up.norm();
    wing.across = up / wing.height;
    wing.normal = along.cross(wing.across);
    return wing;
}

Vector3d wing_gradient(const Wing& wing, int k)
{
    return wing.weight[k] / wing.height * wing.normal;
}

// Block (k, l) of the second derivative of the wing's rotation about the edge, without the part that cancels between
// the two wings.
Matrix3d wing_hessian(const Wing& wing, const Vector3d& along, double length, int k, int l)
{
    const Matrix3d mn = wing.across * wing.normal.transpose();
    const Matrix3d en = along * wing.normal.transpose();
    const double h = wing.height;
    return -wing.weight[k] * wing.weight[l] / (h * h) * (mn + mn.transpose()) -
           (wing.weight[k] * edge_weight[l] * en + edge_weight[k] * wing.weight[l] * en.transpose()) / (length * h) -
           edge_weight[k] * edge_weight[l] / (2 * length * length) * (mn + mn.transpose());
}

void add_wing(HingeAngle& out, const Wing& wing, const Vector3d& along, double length, double sign, int apex)
{
    const std::array<int, 3> vertex = {0, 1, apex};
    for (int k = 0; k < 3; ++k) {
        out.gradient.segment<3>(3 * vertex[k]) += sign * wing_gradient(wing, k);
        for (int l = 0; l < 3; ++l) {
            out.hessian.block<3, 3>(3 * vertex[k], 3 * vertex[l]) += sign * wing_hessian(wing, along, length, k, l);
        }
    }
}

} // namespace

double hinge_angle(const HingePoints& p)
{
    const Vector3d edge = p.x1 - p.x0;
    const Vector3d left = edge.cross(p.x2 - p.x0);
    const Vector3d right = (p.x3 - p.x0).cross(edge);
    return portable_atan2(-left.dot(p.x3 - p.x0) * edge.norm(), left.dot(right));
}

Eigen::Matrix<double, 12, 1> hinge_angle_gradient(const HingePoints& p)
{
    const Vector3d edge = p.x1 - p.x0;
    const double length = edge.norm();
    Eigen::Matrix<double, 12, 1> gradient = Eigen::Matrix<double, 12, 1>::Zero();
    const Wing left = make_wing(p.x0, edge / length, length, p.x2);
    const Wing right = make_wing(p.x0, edge / length, length, p.x3);
    for (int k = 0; k < 3; ++k) {
        gradient.segment<3>(3 * (k < 2 ? k : 2)) -= wing_gradient(left, k);
        gradient.segment<3>(3 * (k < 2 ? k : 3)) += wing_gradient(right, k);
    }
    return gradient;
}

HingeAngle hinge_angle_derivatives(const HingePoints& p)
{
    const Vector3d edge = p.x1 - p.x0;
    const double length = edge.norm();
    const Vector3d along = edge / length;
    HingeAngle out;
    out.angle = hinge_angle(p);
    out.gradient.setZero();
    out.hessian.setZero();
    add_wing(out, make_wing(p.x0, along, length, p.x2), along, length, -1, 2);
    add_wing(out, make_wing(p.x0, along, length, p.x3), along, length, 1, 3);
    return out;
}

double ridge_weight(const HingeLaw& law)
{
    const double span = pi - law.ridge_start;
    return law.ridge_height * law.concavity_weight * (1 - law.convex_weight) * pi * pi / (span * span);
}

HingeResponse hinge_response(const HingeLaw& law, double angle)
{
    const double weight = angle < 0 ? law.concavity_weight : law.convex_weight * law.concavity_weight;
    HingeResponse out{weight * angle * angle, 0, 2 * weight * angle, 2 * weight};
    const double excess = angle - law.ridge_start;
    if (excess > 0) {
        const double ridge = ridge_weight(law);
        out.ridge = ridge * excess * excess;
        out.moment += 2 * ridge * excess;
        out.stiffness += 2 * ridge;
    }
    return out;
}

} // namespace rhombloom
