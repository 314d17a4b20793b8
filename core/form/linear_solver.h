#pragma once

#include <memory>

#include "core/form/block_matrix.h"

namespace rhombloom {

//! \brief Cholesky factorisation of symmetric block matrices that share one pattern.
//! \details Multifrontal (Duff and Reid 1983; Liu 1992): the factor is a tree of dense fronts, factored by
//! DenseKernels, subtrees in parallel. Every entry is summed in the same order whatever the number of threads. Own code
//! because the fast alternative, CHOLMOD's supernodal module, is under the GPL, and is not faster.
class LinearSolver
{
public:
    //! \brief Order and analyse the pattern of \p matrix once for all factorisations.
    //! \details The last four small patterns are remembered when their solvers are gone.
    explicit LinearSolver(const BlockMatrix& matrix, int threads = 1);
    ~LinearSolver();
    LinearSolver(LinearSolver&&) noexcept;
    LinearSolver& operator=(LinearSolver&&) noexcept;

    //! \brief Factor \p matrix + \p shift * identity; false when that is not positive definite.
    bool factor(const BlockMatrix& matrix, double shift);

    //! \brief Solve with the last factorisation, which must have succeeded.
    Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

    //! \brief The block rows in the order of elimination: parts of the surface, one after the other.
    const std::vector<int>& order() const;

    //! \brief Multiplications of one factorisation.
    double work() const;

private:
    struct Factor;
    class Shelf;
    static Shelf& shelf();
    std::unique_ptr<Factor> factor_;
};

} // namespace rhombloom
