#include "core/form/linear_solver.h"

#include <Eigen/SparseCholesky>

namespace rhombloom {

using SparseMatrix = Eigen::SparseMatrix<double>;

struct LinearSolver::Factor
{
    SparseMatrix matrix;
    Eigen::SimplicialLLT<SparseMatrix> llt;
};

namespace {

SparseMatrix expand(const BlockMatrix& matrix, double shift)
{
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(matrix.value.size());
    for (int j = 0; j < matrix.size; ++j) {
        for (int k = matrix.start[j]; k < matrix.start[j + 1]; ++k) {
            for (int column = 0; column < 3; ++column) {
                for (int row = 0; row < 3; ++row) {
                    const int i = 3 * matrix.row[k] + row;
                    const double value = matrix.value[9 * k + 3 * column + row];
                    entries.emplace_back(i, 3 * j + column, i == 3 * j + column ? value + shift : value);
                }
            }
        }
    }
    SparseMatrix expanded(3 * matrix.size, 3 * matrix.size);
    expanded.setFromTriplets(entries.begin(), entries.end());
    return expanded;
}

} // namespace

LinearSolver::LinearSolver(const BlockMatrix& pattern) : factor_(std::make_unique<Factor>())
{
    factor_->llt.analyzePattern(expand(pattern, 1));
}

LinearSolver::~LinearSolver() = default;

bool LinearSolver::factor(const BlockMatrix& matrix, double shift)
{
    factor_->matrix = expand(matrix, shift);
    factor_->llt.factorize(factor_->matrix);
    return factor_->llt.info() == Eigen::Success;
}

Eigen::VectorXd LinearSolver::solve(const Eigen::VectorXd& right_side) const
{
    return factor_->llt.solve(right_side);
}

} // namespace rhombloom
