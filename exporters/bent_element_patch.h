#pragma once

#include <array>

#include <Eigen/Core>

#include "core/model/element.h"
#include "exporters/outline.h"

namespace rhombloom {

using Vec3 = Eigen::Vector3d;

//! Which of the piece's faces looks outward: the one drawn by element_outline(), or its back.
enum class Outward : int
{
    Front = 1,
    Back = -1
};

inline double sign(Outward outward)
{
    return static_cast<double>(static_cast<int>(outward));
}

//! \brief The middle surface of one bent sheet: a polynomial over the flat piece's plane (Bezier form).
struct BentPatch
{
    static constexpr int degree_along = 7;  //!< along the long sides
    static constexpr int degree_across = 5; //!< along the short sides
    static constexpr int controls = (degree_along + 1) * (degree_across + 1);
    //! The controls of the piece's corners v0..v3.
    static constexpr std::array<int, 4> corners = {0, degree_along*(degree_across + 1), controls - 1, degree_across};

    using Controls = Eigen::Matrix<double, 3, controls>;
    using Basis = Eigen::Matrix<double, controls, 1>;

    Controls control = Controls::Zero();
    Eigen::Matrix2d to_unit = Eigen::Matrix2d::Identity(); //!< flat mm to (u, v) in the unit square of the rhomboid
};

//! \brief The basis at (u, v), differentiated \p du times along u and \p dv times along v (0..2 each).
BentPatch::Basis patch_basis(double u, double v, int du, int dv);

//! \brief The rhomboid's sides as columns, flat mm: (u, v) -> point.
Eigen::Matrix2d rhomboid(const Element& element);

//! \brief The rhomboid's corners v0..v3, flat mm.
std::array<Vec2, 4> flat_corners(const Element& element);

//! \brief Where the flat point \p p (mm) goes.
Vec3 bent_position(const BentPatch& patch, const Vec2& p);

//! \brief Unit normal there, on the side \p outward.
Vec3 bent_normal(const BentPatch& patch, const Vec2& p, Outward outward);

} // namespace rhombloom
