#pragma once

#include <memory>

#include "core/form/block_matrix.h"

namespace rhombloom {

//! \brief Cholesky factorisation of symmetric block matrices that share one pattern.
class LinearSolver
{
public:
    explicit LinearSolver(const BlockMatrix& pattern);
    ~LinearSolver();
    LinearSolver(const LinearSolver&) = delete;
    LinearSolver& operator=(const LinearSolver&) = delete;

    //! \brief Factor \p matrix + \p shift * identity; false when that is not positive definite.
    bool factor(const BlockMatrix& matrix, double shift);

    //! \brief Solve with the last factorisation that succeeded.
    Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

private:
    struct Factor;
    std::unique_ptr<Factor> factor_;
};

} // namespace rhombloom
