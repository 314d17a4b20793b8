#pragma once

#include <Eigen/Cholesky>

#include "exporters/bent_element_patch.h"

namespace rhombloom {

//! \brief What all elements of a design share: the thin-sheet energy and a factored model of it.
//! \details Everything happens in the element's own frame: x along the long sides, z outward, mirrored for elements
//! that are turned over, so that equal elements have equal coordinates.
struct SheetMechanics
{
    static constexpr int unknowns = 3 * (BentPatch::controls - 4);
    static constexpr int samples_along = 11;
    static constexpr int samples_across = 8;
    static constexpr int samples = samples_along * samples_across;
    using Vector = Eigen::Matrix<double, unknowns, 1>;
    using Matrix = Eigen::MatrixXd; //!< unknowns x unknowns, too large for the stack

    Element element;
    double pivot = 0; //!< Rp, mm
    Eigen::Matrix2d to_unit = Eigen::Matrix2d::Identity();
    Eigen::Matrix<double, samples, 1> weights; //!< of the samples, mm2
    Eigen::MatrixXd slopes; //!< of the basis at sample i along flat x (row i) and y (row samples + i), 1/mm
    Eigen::Matrix<double, BentPatch::controls, BentPatch::controls> bending; //!< energy of curvature
    //! Basis at the seats, where hooks hold two sheets together: Rp from side k's first (2k) and second corner (2k + 1).
    Eigen::Matrix<double, 8, BentPatch::controls> seats;
    double seat_weight = 0;   //!< mm2 of membrane energy per mm2 of distance
    BentPatch mean;           //!< the solution for the mean element
    Eigen::LLT<Matrix> model; //!< of the energy's second derivative there
};

//! \brief Sample the sheet and solve the mean element with the corners \p mean (own frame).
SheetMechanics sheet_mechanics(const Element& element, const HookParameters& hooks, const std::array<Vec3, 4>& mean);

struct BendOptions
{
    int iterations = 60;
    double stop = 1e-5; //!< smallest relative gain of an iteration
};

//! \brief Bend the sheet between four corners: membrane energy plus t^2/12 times curvature energy (a thin shell), and
//! seats that hold both sheets of a joint on the straight line between the nodes, Rp from each.
//! \details Minimised by L-BFGS on the mean element's factored model.
//! \param corners of the piece v0..v3 in the own frame; they are met exactly.
//! \param start the shape of an element much like it.
BentPatch bend(const SheetMechanics& mechanics, const std::array<Vec3, 4>& corners, const BentPatch& start,
               const BendOptions& options = {});

} // namespace rhombloom
