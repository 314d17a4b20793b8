#include "core/form/linear_solver.h"

#include <gtest/gtest.h>

#include <random>

#include "core/form/embedding_energy.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom {
namespace {

// The positive semidefinite part of a ball's Hessian, with random values on the diagonal.
BlockMatrix ball_matrix(int level)
{
    const Surface surface = shapes::ball_surface(level);
    EmbedOptions options;
    options.convex_weight = 0.1;
    const EmbeddingTerms terms = embedding_terms(surface, {}, options);
    Eigen::VectorXd x(3 * terms.vertex_count);
    for (const Vertex v : surface.vertices()) {
        x.segment<3>(3 * v.idx()) = surface.point(v) / 80;
    }
    HessianPattern pattern;
    BlockMatrix matrix = hessian_matrix(terms, pattern);
    embedding_hessian(terms, pattern, x, {1}, matrix);
    return matrix;
}

double relative_residual(const BlockMatrix& matrix, const LinearSolver& solver, double shift)
{
    const Eigen::VectorXd b = Eigen::VectorXd::Random(3 * matrix.size);
    const Eigen::VectorXd x = solver.solve(b);
    Eigen::VectorXd product;
    multiply(matrix, x, product);
    return (product + shift * x - b).norm() / (b.norm() + product.norm());
}

TEST(LinearSolver, SolvesWhatItFactored)
{
    for (const int level : {0, 1, 2, 3}) {
        const BlockMatrix matrix = ball_matrix(level);
        LinearSolver solver(matrix);
        ASSERT_TRUE(solver.factor(matrix, 0.1));
        EXPECT_LT(relative_residual(matrix, solver, 0.1), 1e-12) << matrix.size;
    }
}

TEST(LinearSolver, GivesTheSameBytesWithAnyNumberOfThreads)
{
    const BlockMatrix matrix = ball_matrix(4);
    const Eigen::VectorXd b = Eigen::VectorXd::Ones(3 * matrix.size);
    LinearSolver one(matrix, 1);
    ASSERT_TRUE(one.factor(matrix, 0.1));
    for (const int threads : {2, 3}) {
        LinearSolver more(matrix, threads);
        ASSERT_TRUE(more.factor(matrix, 0.1));
        EXPECT_EQ(one.solve(b), more.solve(b)) << threads;
    }
}

TEST(LinearSolver, RefusesAnIndefiniteMatrix)
{
    const BlockMatrix matrix = ball_matrix(2);
    LinearSolver solver(matrix, 2);
    EXPECT_FALSE(solver.factor(matrix, -0.1));
    EXPECT_TRUE(solver.factor(matrix, 0.1));
}

TEST(LinearSolver, RemembersAPatternButNotItsValues)
{
    const BlockMatrix matrix = ball_matrix(2);
    BlockMatrix other = matrix;
    for (double& value : other.value) {
        value *= 2;
    }
    const Eigen::VectorXd b = Eigen::VectorXd::Ones(3 * matrix.size);
    const auto solution = [&](const BlockMatrix& m, int threads) {
        LinearSolver solver(m, threads);
        EXPECT_TRUE(solver.factor(m, 0.1));
        return solver.solve(b);
    };
    const Eigen::VectorXd first = solution(matrix, 1);
    solution(other, 1);
    for (const int level : {0, 1}) {
        const BlockMatrix smaller = ball_matrix(level);
        LinearSolver solver(smaller);
        ASSERT_TRUE(solver.factor(smaller, 0.1));
        EXPECT_LT(relative_residual(smaller, solver, 0.1), 1e-12) << level;
    }
    EXPECT_EQ(solution(matrix, 1), first);
    EXPECT_EQ(solution(matrix, 2), first);
    LinearSolver one(matrix); // two at a time share nothing
    LinearSolver two(matrix);
    ASSERT_TRUE(one.factor(matrix, 0.1));
    ASSERT_TRUE(two.factor(other, 0.1));
    EXPECT_EQ(one.solve(b), first);
}

TEST(LinearSolver, TreatsPartsThatAreNotConnected)
{
    BlockMatrix matrix = make_block_matrix(5, {{0, 1}, {4, 3}});
    for (int j = 0; j < 5; ++j) {
        Eigen::Map<Eigen::Matrix3d>(&matrix.value[9 * block_index(matrix, j, j)]) = 4 * Eigen::Matrix3d::Identity();
    }
    Eigen::Map<Eigen::Matrix3d>(&matrix.value[9 * block_index(matrix, 0, 1)]) = Eigen::Matrix3d::Random();
    LinearSolver solver(matrix);
    ASSERT_TRUE(solver.factor(matrix, 0));
    EXPECT_LT(relative_residual(matrix, solver, 0), 1e-15);
}

} // namespace
} // namespace rhombloom
