#include "core/form/graph_laplacian.h"

#include <Eigen/SparseCholesky>

#include "core/expected.h"
#include "core/form/elimination_tree.h"

namespace rhombloom {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

// Rows and columns in the order of elimination.
SparseMatrix laplacian(const EmbeddingTerms& terms, const LaplacianWeights& weights, const std::vector<int>& position)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (int v = 0; v < terms.vertex_count; ++v) {
        entries.emplace_back(v, v, weights.shift);
    }
    for (std::size_t k = 0; k < terms.springs.size(); ++k) {
        const double weight = k < std::size_t(terms.edge_count) ? weights.edge : weights.diagonal;
        const int a = position[terms.springs[k].a];
        const int b = position[terms.springs[k].b];
        if (weight != 0) {
            entries.emplace_back(a, a, weight);
            entries.emplace_back(b, b, weight);
            entries.emplace_back(std::max(a, b), std::min(a, b), -weight);
        }
    }
    SparseMatrix matrix(terms.vertex_count, terms.vertex_count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

std::vector<int> elimination_order(const EmbeddingTerms& terms)
{
    std::vector<std::pair<int, int>> pairs;
    for (const SpringPair& pair : terms.springs) {
        pairs.emplace_back(pair.a, pair.b);
    }
    return fill_reducing_order(make_block_matrix(terms.vertex_count, std::move(pairs)));
}

} // namespace

struct GraphLaplacian::Factor
{
    std::vector<int> order;
    SparseMatrix lower; // each column begins with its diagonal entry
};

GraphLaplacian::GraphLaplacian(const EmbeddingTerms& terms, const LaplacianWeights& weights)
    : factor_(std::make_unique<Factor>())
{
    factor_->order = elimination_order(terms);
    std::vector<int> position(factor_->order.size());
    for (std::size_t k = 0; k < position.size(); ++k) {
        position[factor_->order[k]] = static_cast<int>(k);
    }
    const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> cholesky(
        laplacian(terms, weights, position));
    expects(cholesky.info() == Eigen::Success, "GraphLaplacian: weights that make it positive definite");
    factor_->lower = cholesky.matrixL();
}

GraphLaplacian::~GraphLaplacian() = default;

// All three columns together, as they ask for the same entries of the factor.
Eigen::MatrixX3d GraphLaplacian::solve(const Eigen::MatrixX3d& right_sides) const
{
    const SparseMatrix& lower = factor_->lower;
    Eigen::Matrix3Xd y = right_sides(factor_->order, Eigen::all).transpose();
    const auto column = [&](Eigen::Index j) {
        return std::pair(lower.outerIndexPtr()[j], lower.outerIndexPtr()[j + 1]);
    };
    const double* value = lower.valuePtr();
    const int* row = lower.innerIndexPtr();
    for (Eigen::Index j = 0; j < lower.cols(); ++j) {
        const auto [begin, end] = column(j);
        const Eigen::Vector3d pivot = y.col(j) /= value[begin];
        for (int k = begin + 1; k < end; ++k) {
            y.col(row[k]) -= value[k] * pivot;
        }
    }
    for (Eigen::Index j = lower.cols(); j-- > 0;) {
        const auto [begin, end] = column(j);
        Eigen::Vector3d sum = y.col(j);
        for (int k = begin + 1; k < end; ++k) {
            sum -= value[k] * y.col(row[k]);
        }
        y.col(j) = sum / value[begin];
    }
    Eigen::MatrixX3d out(right_sides.rows(), 3);
    out(factor_->order, Eigen::all) = y.transpose();
    return out;
}

} // namespace rhombloom
