#pragma once

#include "core/form/embedding_energy.h"
#include "core/form/line_search.h"
#include "core/form/linear_solver.h"

namespace rhombloom {

//! \brief The linear systems of one minimisation: the pattern and its symbolic factorisation are made once.
class NewtonSystem
{
public:
    NewtonSystem(const EmbeddingTerms& terms, int threads);

    //! \brief Newton's direction with the exact Hessian.
    //! \details Only where that is not positive definite, a share of its indefinite part is removed: raised until the
    //! factorisation succeeds, lowered after every success.
    Eigen::VectorXd direction(const Iterate& iterate);

    //! \brief Factor the Hessian as \p options say; false when it is not positive definite.
    bool factor(const Iterate& iterate, const HessianOptions& options);

    //! \brief Assemble the Hessian as \p options say, for product(); what was factored stays.
    void assemble(const Iterate& iterate, const HessianOptions& options);

    //! \brief The Hessian that was assembled last times \p vector.
    Eigen::VectorXd product(const Eigen::VectorXd& vector) const;

    //! \brief Solve with what was factored last.
    Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

private:
    void lower_damping();
    void raise_damping();

    const EmbeddingTerms& terms_;
    HessianPattern pattern_;
    BlockMatrix hessian_;
    LinearSolver solver_;
    int threads_;
    double damping_ = 0;
    double shift_;
};

} // namespace rhombloom
