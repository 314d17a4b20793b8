#include "core/design/mesh_import/metric_misfit.h"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/SparseCholesky>

namespace rhombloom {

namespace {

using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

//! Of equilateral triangles, plus \p shift on the diagonal.
SparseMatrix laplacian(const EditMesh& mesh, double shift)
{
    const double weight = 1 / std::sqrt(3.0);
    std::vector<Eigen::Triplet<double>> entries;
    const int n = static_cast<int>(mesh.n_vertices());
    for (int v = 0; v < n; ++v) {
        entries.emplace_back(v, v, shift);
    }
    for (const auto e : mesh.edges()) {
        const auto h = mesh.halfedge_handle(e, 0);
        const int a = mesh.from_vertex_handle(h).idx();
        const int b = mesh.to_vertex_handle(h).idx();
        entries.emplace_back(a, a, weight);
        entries.emplace_back(b, b, weight);
        entries.emplace_back(a, b, -weight);
        entries.emplace_back(b, a, -weight);
    }
    SparseMatrix result(n, n);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

} // namespace

struct MetricMisfit::Factors
{
    Eigen::SimplicialLDLT<SparseMatrix> plain;    //!< of the Laplacian
    Eigen::SimplicialLDLT<SparseMatrix> smoothed; //!< of 1 + Laplacian
};

MetricMisfit::MetricMisfit(const EditMesh& mesh, VectorXd residual)
    : factors_(std::make_unique<Factors>()), residual_(std::move(residual))
{
    constexpr double ground = 1e-7; // the Laplacian alone is singular; curvatures are zero in sum
    factors_->plain.compute(laplacian(mesh, ground));
    factors_->smoothed.compute(laplacian(mesh, 1));
    residual_.array() -= residual_.mean();
    pull_ = squared(residual_);
}

MetricMisfit::~MetricMisfit() = default;

//! 1 / (L (1 + L)), squared, where 1 / (L (1 + L)) = 1 / L - 1 / (1 + L).
VectorXd MetricMisfit::squared(const VectorXd& curvature) const
{
    VectorXd u = curvature;
    for (int k = 0; k < 2; ++k) {
        VectorXd next = factors_->plain.solve(u);
        next -= factors_->smoothed.solve(u);
        next.array() -= next.mean();
        u = std::move(next);
    }
    return u;
}

double MetricMisfit::value() const
{
    return residual_.dot(pull_);
}

double MetricMisfit::first_order(const CurvatureChange& change) const
{
    double result = 0;
    for (int i = 0; i < 4; ++i) {
        result += 2 * change.amount[i] * pull_[change.vertex[i]];
    }
    return result;
}

VectorXd MetricMisfit::response(const CurvatureChange& change) const
{
    VectorXd added = VectorXd::Zero(residual_.size());
    for (int i = 0; i < 4; ++i) {
        added[change.vertex[i]] += change.amount[i];
    }
    return squared(added);
}

double MetricMisfit::own_square(const CurvatureChange& change, const VectorXd& response)
{
    double result = 0;
    for (int i = 0; i < 4; ++i) {
        result += change.amount[i] * response[change.vertex[i]];
    }
    return result;
}

void MetricMisfit::apply(const CurvatureChange& change, const VectorXd& response)
{
    for (int i = 0; i < 4; ++i) {
        residual_[change.vertex[i]] += change.amount[i];
    }
    pull_ += response;
}

} // namespace rhombloom
