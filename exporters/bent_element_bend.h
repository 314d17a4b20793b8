#pragma once

#include <vector>

#include <Eigen/Cholesky>

#include "exporters/bent_element_patch.h"

namespace rhombloom {

//! \brief A point of the flat piece that is drawn to a place in space: where hooks hold two sheets together.
struct Seat
{
    BentPatch::Basis basis; //!< at the flat point
    double weight = 0;      //!< mm2 of membrane energy per mm2 of distance; 0: free
};

//! \brief What all elements of a design share: the thin-sheet energy and a factored model of it.
//! \details Everything happens in the element's own frame: x along the long sides, z outward, mirrored for elements
//! that are turned over, so that equal elements have equal coordinates.
struct SheetMechanics
{
    static constexpr int unknowns = 3 * (BentPatch::controls - 4);
    using Vector = Eigen::Matrix<double, unknowns, 1>;
    using Matrix = Eigen::MatrixXd; //!< unknowns x unknowns, too large for the stack

    Element element;
    double pivot = 0; //!< Rp, mm
    Eigen::Matrix2d to_unit;
    Eigen::VectorXd weights; //!< of the samples, mm2
    Eigen::MatrixXd slopes;  //!< of the basis at sample i along flat x (column 2i) and y (2i + 1), 1/mm
    Eigen::Matrix<double, BentPatch::controls, BentPatch::controls> bending; //!< energy of curvature
    std::array<Seat, 8> seats; //!< two per side: Rp from side k's first (2k) and second corner (2k + 1)
    BentPatch mean;            //!< the solution for the mean element, where every other starts
    Eigen::LLT<Matrix> model;  //!< of the energy's second derivative there
};

//! \brief Sample the sheet and solve the mean element with the corners \p mean (own frame).
SheetMechanics sheet_mechanics(const Element& element, const HookParameters& hooks, const std::array<Vec3, 4>& mean);

//! \brief Bend the sheet between four corners: membrane energy plus t^2/12 times curvature energy (a thin shell), and
//! seats that hold both sheets of a joint on the straight line between the nodes, Rp from each.
//! \details Minimised by L-BFGS on the mean element's factored model.
//! \param corners of the piece v0..v3 in the own frame; they are met exactly.
BentPatch bend(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners);

} // namespace rhombloom
