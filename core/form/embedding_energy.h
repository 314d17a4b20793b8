#pragma once

#include "core/form/block_matrix.h"
#include "core/form/embedding_terms.h"

namespace rhombloom {

//! \brief The energy in units of la, by cause.
struct EnergyParts
{
    double spring = 0;
    double concavity = 0;
    double guard = 0; //!< barrier and ridge, zero on valid shapes

    double total() const { return spring + concavity + guard; }
};

//! \brief Energy of the positions \p x (three coordinates per vertex, in units of la).
EnergyParts embedding_energy(const EmbeddingTerms& terms, const Eigen::VectorXd& x);

//! \brief The same, and the gradient by \p x, zero for the vertices that are held.
EnergyParts embedding_gradient(const EmbeddingTerms& terms, const Eigen::VectorXd& x, Eigen::VectorXd& gradient);

//! \brief Numbers of terms that are added to the Hessian one after the other.
struct HessianPart
{
    std::vector<int> springs;
    std::vector<int> hinges;
};

//! \brief Where the terms' blocks lie in the matrix.
struct HessianPattern
{
    std::vector<std::array<int, 3>> spring_blocks; //!< (a, a), (b, b), (a, b); -1: held
    std::vector<std::array<int, 10>> hinge_blocks; //!< (k, l) for k = 0..3, l = 0..k
    std::vector<HessianPart> parts;                //!< no two touch the same block, so threads may share them out
    HessianPart rest;                              //!< what comes after the parts; at first everything
};

BlockMatrix hessian_matrix(const EmbeddingTerms& terms, HessianPattern& pattern);

//! \brief Cut the terms of a large surface into parts by an order in which neighbours are mostly near to each other.
void divide_by(const std::vector<int>& order, const EmbeddingTerms& terms, HessianPattern& pattern);

//! \brief How the Hessian deviates from the exact one; by default it does not.
struct HessianOptions
{
    //! Share removed of the indefinite part (1: positive semidefinite): the lateral stiffness of compressed springs and
    //! the curvature of the hinge angles. Elements in equilibrium are prestressed, so this part carries the bending
    //! stiffness and must not be removed for good.
    double damping = 0;
    //! What each hinge's moment and stiffness count as, instead of their own; null: their own.
    const std::vector<HingeResponse>* hinges = nullptr;
    int threads = 1; //!< the Hessian does not depend on it
};

void embedding_hessian(const EmbeddingTerms& terms, const HessianPattern& pattern, const Eigen::VectorXd& x,
                       const HessianOptions& options, BlockMatrix& hessian);

} // namespace rhombloom
