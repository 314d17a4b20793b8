#include "core/form/concavity_energy.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/form/term_kernels.h"
#include "core/units.h"

namespace rhombloom {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// One triangle over the edge. With the weights w = (-(1 - s), -s, 1) of (x0, x1, apex), s being the apex's foot on the
// edge, and the signs e = (-1, 1, 0), its turning about the edge has the derivatives
//     gradient_k = w_k turn,
//     hessian_kl = -(w_k w_l + share e_k e_l) (up turn' + turn up') - w_k e_l along turn' - e_k w_l turn along',
// without the part that cancels between the two triangles of a hinge.
struct Wing
{
    std::array<double, 3> weight;
    Vector3d turn;   // unit normal / height
    double share;    // height^2 / (2 length^2)
    Matrix3d across; // up turn' + turn up', where up is the unit vector from the edge to the apex / height
    Matrix3d along;  // along turn', where along is the unit vector of the edge / its length
};

constexpr std::array<double, 3> edge_sign = {-1, 1, 0};

Wing make_wing(const Vector3d& x0, const Vector3d& edge, const Vector3d& apex)
{
    const double square = edge.squaredNorm();
    const Vector3d r = apex - x0;
    const double s = r.dot(edge) / square;
    const Vector3d height = r - s * edge;
    const Vector3d up = height / height.squaredNorm();
    Wing wing;
    wing.weight = {-(1 - s), -s, 1};
    wing.turn = edge.cross(up) / std::sqrt(square);
    wing.share = height.squaredNorm() / (2 * square);
    wing.across = up * wing.turn.transpose() + wing.turn * up.transpose();
    wing.along = (edge / square) * wing.turn.transpose();
    return wing;
}

Matrix3d wing_hessian(const Wing& wing, int k, int l)
{
    const double both = wing.weight[k] * wing.weight[l] + wing.share * edge_sign[k] * edge_sign[l];
    return -both * wing.across - (wing.weight[k] * edge_sign[l]) * wing.along -
           (edge_sign[k] * wing.weight[l]) * wing.along.transpose();
}

std::array<Wing, 2> wings(const HingePoints& p)
{
    const Vector3d edge = p.x1 - p.x0;
    return {make_wing(p.x0, edge, p.x2), make_wing(p.x0, edge, p.x3)};
}

// By (x0, x1, x2, x3): the angle grows as the right wing turns, and falls as the left one does.
std::array<Vector3d, 4> gradient_of(const std::array<Wing, 2>& w)
{
    return {w[1].weight[0] * w[1].turn - w[0].weight[0] * w[0].turn,
            w[1].weight[1] * w[1].turn - w[0].weight[1] * w[0].turn, -w[0].turn, w[1].turn};
}

} // namespace

HingePoints hinge_points(const Eigen::VectorXd& x, const HingeVertices& hinge)
{
    return {x.segment<3>(3 * hinge[0]), x.segment<3>(3 * hinge[1]), x.segment<3>(3 * hinge[2]),
            x.segment<3>(3 * hinge[3])};
}

Vector3d hinge_normal(const HingePoints& p)
{
    const Vector3d edge = p.x1 - p.x0;
    return edge.cross(p.x2 - p.x0) + (p.x3 - p.x0).cross(edge);
}

double hinge_angle(const HingePoints& p)
{
    const Vector3d edge = p.x1 - p.x0;
    const Vector3d left = edge.cross(p.x2 - p.x0);
    const Vector3d right = (p.x3 - p.x0).cross(edge);
    return portable_atan2(-left.dot(p.x3 - p.x0) * edge.norm(), left.dot(right));
}

Eigen::Matrix<double, 12, 1> hinge_angle_gradient(const HingePoints& p)
{
    Eigen::Matrix<double, 12, 1> gradient;
    const std::array<Vector3d, 4> parts = gradient_of(wings(p));
    for (int k = 0; k < 4; ++k) {
        gradient.segment<3>(3 * k) = parts[k];
    }
    return gradient;
}

HingeBlocks hinge_hessian(const HingePoints& p, double stiffness, double moment)
{
    const std::array<Wing, 2> w = wings(p);
    const std::array<Vector3d, 4> g = gradient_of(w);
    HingeBlocks blocks;
    for (int k = 0, n = 0; k < 4; ++k) {
        for (int l = 0; l <= k; ++l, ++n) {
            blocks[n] = (stiffness * g[k]) * g[l].transpose();
            if (k < 3) {
                blocks[n] -= moment * wing_hessian(w[0], k, l);
            }
            if (k != 2 && l != 2) {
                blocks[n] += moment * wing_hessian(w[1], std::min(k, 2), std::min(l, 2));
            }
        }
    }
    return blocks;
}

HingeAngle hinge_angle_derivatives(const HingePoints& p)
{
    HingeAngle out;
    out.angle = hinge_angle(p);
    out.gradient = hinge_angle_gradient(p);
    const HingeBlocks blocks = hinge_hessian(p, 0, 1);
    for (int k = 0, n = 0; k < 4; ++k) {
        for (int l = 0; l <= k; ++l, ++n) {
            out.hessian.block<3, 3>(3 * l, 3 * k) = blocks[n].transpose();
            out.hessian.block<3, 3>(3 * k, 3 * l) = blocks[n];
        }
    }
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

HingeResponse shared_response(const HingeLaw& law, double angle, double share)
{
    HingeResponse out = hinge_response(law, angle);
    out.stiffness += 2 * law.concavity_weight * (1 - law.convex_weight) * (share - (angle < 0 ? 1.0 : 0.0));
    return out;
}

} // namespace rhombloom
