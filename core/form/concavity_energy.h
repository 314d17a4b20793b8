#pragma once

#include <array>

#include <Eigen/Core>

namespace rhombloom {

//! \brief The two corner triangles at one end of an interior edge: x0 -> x1 is the edge, x2 the left apex, x3 the
//! right one, seen from outside (Sec. 3.2).
struct HingePoints
{
    Eigen::Vector3d x0, x1, x2, x3;
};

//! \brief The vertices of a hinge: {x0, x1, left apex, right apex} as in HingePoints.
using HingeVertices = std::array<int, 4>;

//! \brief The points of a hinge among the positions \p x, three coordinates per vertex.
HingePoints hinge_points(const Eigen::VectorXd& x, const HingeVertices& hinge);

//! \brief The normals of the two triangles, outwards and each twice as long as the triangle is large, added.
Eigen::Vector3d hinge_normal(const HingePoints& p);

//! \brief Signed dihedral angle: zero when flat, positive when convex seen from outside, in (-pi, pi].
double hinge_angle(const HingePoints& p);

//! \brief hinge_angle() with its exact gradient and Hessian by (x0, x1, x2, x3).
struct HingeAngle
{
    double angle = 0;
    Eigen::Matrix<double, 12, 1> gradient;
    Eigen::Matrix<double, 12, 12> hessian;
};

//! \brief The gradient alone.
Eigen::Matrix<double, 12, 1> hinge_angle_gradient(const HingePoints& p);

HingeAngle hinge_angle_derivatives(const HingePoints& p);

//! \brief The blocks (k, l), k = 0..3, l = 0..k, of a Hessian by (x0, x1, x2, x3).
using HingeBlocks = std::array<Eigen::Matrix3d, 10>;

//! \brief `stiffness g g' + moment H`, where g and H are the gradient and the Hessian of hinge_angle().
HingeBlocks hinge_hessian(const HingePoints& p, double stiffness, double moment);

//! \brief What an angle costs. Dimensionless: times la gives millimetres.
struct HingeLaw
{
    double concavity_weight = 1; //!< w of `w gamma^2` for gamma < 0
    double convex_weight = 0;    //!< convex hinges cost convex_weight * w * gamma^2
    double ridge_height = 1;     //!< 0: no ridge
    double ridge_start = 2.4;    //!< radians; valid shapes stay below 1.95
};

//! \brief Energy of one hinge, and its first and second derivative by the angle.
struct HingeResponse
{
    double energy = 0; //!< without the ridge
    double ridge = 0;  //!< makes the energy continuous at +-pi, where a folded hinge changes its sign
    double moment = 0;
    double stiffness = 0;
};

//! \brief Weight of the ridge, which is `weight * (angle - ridge_start)^2`.
double ridge_weight(const HingeLaw& law);

HingeResponse hinge_response(const HingeLaw& law, double angle);

//! \brief hinge_response() for a Hessian that need not know whether the hinge is concave: as stiff as if it were so by
//! \p share, 0 to 1.
HingeResponse shared_response(const HingeLaw& law, double angle, double share);

} // namespace rhombloom
