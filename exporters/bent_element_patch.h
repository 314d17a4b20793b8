#pragma once

#include <array>
#include <vector>

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

//! \brief The middle surface of one bent sheet: a polynomial over the flat piece's plane.
struct BentPatch
{
    static constexpr int degree_along = 7;  //!< along the long sides
    static constexpr int degree_across = 3; //!< along the short sides
    static constexpr int controls = (degree_along + 1) * (degree_across + 1);

    Eigen::Matrix<double, 3, controls> control = Eigen::Matrix<double, 3, controls>::Zero();
    Eigen::Matrix2d to_unit = Eigen::Matrix2d::Identity(); //!< flat mm to (u, v) in the unit square of the rhomboid
};

//! \brief Where the flat point \p p (mm) goes.
Vec3 bent_position(const BentPatch& patch, const Vec2& p);

//! \brief Unit normal there, on the side \p outward.
Vec3 bent_normal(const BentPatch& patch, const Vec2& p, Outward outward);

//! \brief What all elements of a design share: the integrals of the thin-sheet energy.
struct SheetMechanics
{
    struct Sample
    {
        double weight = 0;                                   //!< mm2
        Eigen::Matrix<double, BentPatch::controls, 2> slope; //!< of the basis along flat x and y, 1/mm
    };
    Element element;
    double pivot = 0; //!< Rp, mm
    Eigen::Matrix2d to_unit;
    std::vector<Sample> samples;
    Eigen::Matrix<double, BentPatch::controls, BentPatch::controls> bending; //!< energy of curvature
    std::array<Eigen::Matrix<double, BentPatch::controls, 1>, 4> seats;      //!< basis at the long sides' shoulders
};

SheetMechanics sheet_mechanics(const Element& element, const HookParameters& hooks);

//! \brief Bend the sheet between four corners: membrane energy plus t^2/12 times curvature energy (a thin shell),
//! and the shoulders of the long sides drawn to where the neighbour's slits hold them, Rp from the node.
//! \param corners of the piece v0..v3 in space; they are met exactly.
//! \param start where the iteration begins; its corners need not fit.
BentPatch bend(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners, const BentPatch& start);

//! \brief A start for bend(): the bilinear patch with arcs over its long direction, bowed outward.
BentPatch arched_patch(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners, Outward outward);

//! \brief \p patch moved from its own corners to \p corners: its offsets from the bilinear patch, turned.
BentPatch transferred(const BentPatch& patch, Outward from, const std::array<Vec3, 4>& corners, Outward outward);

} // namespace rhombloom
