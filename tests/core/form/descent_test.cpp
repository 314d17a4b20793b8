#include <gtest/gtest.h>

#include "core/form/elimination_tree.h"
#include "core/form/graph_laplacian.h"
#include "core/form/limited_memory.h"
#include "core/form/minimise.h"
#include "core/form/newton_system.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom {
namespace {

using Eigen::VectorXd;

EmbeddingTerms terms_of(const Surface& surface)
{
    return embedding_terms(surface, {}, {});
}

VectorXd positions(const Surface& surface)
{
    VectorXd x(3 * surface.n_vertices());
    for (const Vertex v : surface.vertices()) {
        x.segment<3>(3 * v.idx()) = surface.point(v) / Element{}.la;
    }
    return x;
}

struct Unfinished
{
    EmbeddingTerms terms;
    Iterate iterate;
};

// A large ball where quasi-Newton steps get no further.
Unfinished after_quasi_newton()
{
    const Surface surface = shapes::ball_surface(4);
    Unfinished result{terms_of(surface), {}};
    result.iterate = iterate_at(result.terms, positions(surface));
    EXPECT_EQ(quasi_newton(result.terms, result.iterate, {}).reason, StopReason::Stalled);
    return result;
}

TEST(GraphLaplacian, SolvesItsEquations)
{
    const EmbeddingTerms terms = terms_of(shapes::ball_surface(2));
    const LaplacianWeights weights{3, 0.5, 0.1};
    const Eigen::MatrixX3d right = Eigen::MatrixX3d::Random(terms.vertex_count, 3);
    const Eigen::MatrixX3d x = GraphLaplacian(terms, weights).solve(right);
    Eigen::MatrixXd product = weights.shift * x;
    for (std::size_t k = 0; k < terms.springs.size(); ++k) {
        const SpringPair& pair = terms.springs[k];
        const double weight = k < std::size_t(terms.edge_count) ? weights.edge : weights.diagonal;
        product.row(pair.a) += weight * (x.row(pair.a) - x.row(pair.b));
        product.row(pair.b) += weight * (x.row(pair.b) - x.row(pair.a));
    }
    EXPECT_LT((product - right).norm(), 1e-10 * right.norm());
}

TEST(LimitedMemory, SolvesAQuadraticOfAsManyUnknownsAsItRemembers)
{
    const VectorXd stiffness = VectorXd::LinSpaced(6, 1, 100);
    LimitedMemory memory(6);
    VectorXd x = VectorXd::Ones(6);
    VectorXd gradient = stiffness.cwiseProduct(x);
    for (int k = 0; k < 7; ++k) {
        const VectorXd d = memory.empty() ? VectorXd(-gradient) : memory.direction(gradient);
        const double exact = -d.dot(gradient) / d.dot(stiffness.cwiseProduct(d));
        memory.remember(exact * d, stiffness.cwiseProduct(exact * d));
        x += exact * d;
        gradient = stiffness.cwiseProduct(x);
    }
    EXPECT_LT(x.norm(), 1e-6);
}

TEST(LimitedMemory, WithTheInverseHessianAsSeedIsNewtonsMethod)
{
    const VectorXd stiffness = VectorXd::LinSpaced(6, 1, 100);
    const VectorXd gradient = VectorXd::Ones(6);
    const VectorXd d =
        LimitedMemory(3).direction(gradient, [&](const VectorXd& g) { return VectorXd(g.cwiseQuotient(stiffness)); });
    EXPECT_LT((d + gradient.cwiseQuotient(stiffness)).norm(), 1e-15);
}

TEST(EmbeddingHessian, IsTheSameInPartsAndWithAnyNumberOfThreads)
{
    const Surface surface = shapes::ball_surface(4);
    EmbedOptions options;
    options.convex_weight = 0.1;
    const EmbeddingTerms terms = embedding_terms(surface, {}, options);
    const VectorXd x = positions(surface);
    HessianPattern pattern;
    BlockMatrix whole = hessian_matrix(terms, pattern);
    embedding_hessian(terms, pattern, x, {}, whole);
    divide_by(fill_reducing_order(whole), terms, pattern);
    EXPECT_LT(pattern.rest.hinges.size(), terms.hinges.size() / 3); // the rest is for one thread
    BlockMatrix parts = whole;
    embedding_hessian(terms, pattern, x, {}, parts);
    const auto values = [](const BlockMatrix& matrix) {
        return VectorXd(Eigen::Map<const VectorXd>(matrix.value.data(), Eigen::Index(matrix.value.size())));
    };
    EXPECT_LT((values(parts) - values(whole)).lpNorm<Eigen::Infinity>(),
              1e-12 * values(whole).lpNorm<Eigen::Infinity>());
    for (const int threads : {2, 3}) {
        BlockMatrix shared = whole;
        embedding_hessian(terms, pattern, x, {0, nullptr, threads}, shared);
        EXPECT_EQ(shared.value, parts.value) << threads;
    }
}

// On a surface that counts as large the same shape has to come out by the other way.
TEST(Minimise, LargeSurfacesConvergeInFewIterations)
{
    const Surface surface = shapes::ball_surface(4);
    const EmbeddingTerms terms = terms_of(surface);
    ASSERT_TRUE(is_large(terms));
    Iterate iterate = iterate_at(terms, positions(surface));
    const MinimiseResult result = minimise(terms, iterate, {});
    EXPECT_EQ(result.reason, StopReason::Converged);
    EXPECT_LT(result.iterations, 250);
    EXPECT_NEAR(iterate.energy, 229.2594380267, 1e-8); // plain L-BFGS ends there as well
}

TEST(InteriorDescent, NeedsADozenFactorisations)
{
    auto [terms, iterate] = after_quasi_newton();
    NewtonSystem system(terms, 1);
    const MinimiseResult result = interior_descent(terms, system, iterate, {});
    EXPECT_EQ(result.reason, StopReason::Converged); // the last factor is good enough for the rest
    EXPECT_LE(result.iterations, 12);
    EXPECT_NEAR(iterate.energy, 229.2594380267, 1e-8);
}

// After more quasi-Newton steps some edges happen to be without tension, and the Hessian is indefinite.
TEST(InteriorDescent, FindsItsWayWhereEdgesAreSlack)
{
    auto [terms, iterate] = after_quasi_newton();
    NewtonSystem system(terms, 1);
    for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(quasi_newton(terms, iterate, {}).reason, StopReason::Stalled);
    }
    EXPECT_FALSE(system.factor(iterate, {}));
    interior_descent(terms, system, iterate, {});
    EXPECT_LE(iterate.gradient_norm(), 1e-5);
    EXPECT_NEAR(iterate.energy, 229.2594380267, 1e-6);
}

// There the hinges become stiff over a width of angles, and the interior-point method goes on from that.
TEST(Newton, ConvergesOnALargeSurfaceFromWhereTheHessianIsIndefinite)
{
    auto [terms, iterate] = after_quasi_newton();
    NewtonSystem system(terms, 1);
    ASSERT_FALSE(system.factor(iterate, {}));
    const MinimiseResult result = newton_with(system, terms, iterate, {});
    EXPECT_EQ(result.reason, StopReason::Converged);
    EXPECT_LT(result.iterations, 40);
    EXPECT_NEAR(iterate.energy, 229.2594380267, 1e-6);
}

TEST(InteriorDescent, NeverLeavesAWorseShape)
{
    Surface surface = shapes::ball_surface(3);
    shapes::add_noise(surface, 40, 1); // far away, where the method is not meant to begin
    const EmbeddingTerms terms = terms_of(surface);
    Iterate iterate = iterate_at(terms, positions(surface));
    const double before = iterate.energy;
    NewtonSystem system(terms, 1);
    interior_descent(terms, system, iterate, {});
    EXPECT_LE(iterate.energy, before);
    EXPECT_EQ(iterate_at(terms, iterate.x).energy, iterate.energy);
}

} // namespace
} // namespace rhombloom
