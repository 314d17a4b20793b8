// The closed-form derivatives against central differences.

#include <gtest/gtest.h>

#include <random>

#include "core/form/embedding_energy.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom {
namespace {

using Eigen::VectorXd;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

HingePoints points_of(const Vector12& x)
{
    return {x.segment<3>(0), x.segment<3>(3), x.segment<3>(6), x.segment<3>(9)};
}

// Fourth-order central difference of a function of twelve coordinates.
template <class Function>
auto difference(const Function& f, const Vector12& x, int i, double step) -> decltype(f(x))
{
    Vector12 e = Vector12::Zero();
    e[i] = step;
    return (8.0 * (f(x + e) - f(x - e)) - (f(x + 2 * e) - f(x - 2 * e))) / (12 * step);
}

// Corner triangles from comfortable to nearly degenerate: apexes as near to the edge as `thinness`.
Vector12 random_hinge(std::mt19937_64& random, double thinness)
{
    std::normal_distribution<double> normal;
    Vector12 x;
    for (double& coordinate : x) {
        coordinate = normal(random);
    }
    const Vec3 edge = x.segment<3>(3) - x.segment<3>(0);
    for (int apex = 6; apex < 12; apex += 3) {
        const Vec3 r = x.segment<3>(apex) - x.segment<3>(0);
        const Vec3 foot = edge * (r.dot(edge) / edge.squaredNorm());
        x.segment<3>(apex) = x.segment<3>(0) + foot + thinness * (r - foot);
    }
    return x;
}

// Largest deviations from central differences, relative to 1/reach and 1/reach^2: the reach is how far a vertex has to
// go to turn the angle by about one radian.
struct Deviation
{
    double gradient = 0;
    double hessian = 0;
};

void compare(const Vector12& x, Deviation& worst)
{
    const HingeAngle exact = hinge_angle_derivatives(points_of(x));
    const double reach = 1 / exact.gradient.cwiseAbs().maxCoeff();
    const double step = 1e-3 * reach;
    for (int i = 0; i < 12; ++i) {
        const double slope = difference([](const Vector12& y) { return hinge_angle(points_of(y)); }, x, i, step);
        worst.gradient = std::max(worst.gradient, std::abs(slope - exact.gradient[i]) * reach);
        const Vector12 column = difference(
            [](const Vector12& y) { return Vector12(hinge_angle_derivatives(points_of(y)).gradient); }, x, i, step);
        worst.hessian = std::max(worst.hessian, (column - exact.hessian.col(i)).cwiseAbs().maxCoeff() * reach * reach);
    }
}

TEST(HingeAngle, DerivativesMatchCentralDifferencesOnTenThousandConfigurations)
{
    std::mt19937_64 random(1);
    Deviation worst;
    int compared = 0;
    while (compared < 10000) {
        const Vector12 x = random_hinge(random, compared % 4 == 0 ? 0.02 : 1);
        if (std::abs(std::abs(hinge_angle(points_of(x))) - pi) > 0.01) { // a difference would step over the jump
            compare(x, worst);
            ++compared;
        }
    }
    std::printf("largest relative deviation: gradient %.1e, Hessian %.1e\n", worst.gradient, worst.hessian);
    EXPECT_LT(worst.gradient, 1e-7);
    EXPECT_LT(worst.hessian, 1e-6);
}

TEST(HingeAngle, HessianIsSymmetric)
{
    std::mt19937_64 random(2);
    for (int k = 0; k < 1000; ++k) {
        const HingeAngle exact = hinge_angle_derivatives(points_of(random_hinge(random, 1)));
        EXPECT_LT((exact.hessian - exact.hessian.transpose()).norm(), 1e-10 * (1 + exact.hessian.norm()));
    }
}

TEST(HingeAngle, IsPositiveWhereTheSurfaceIsConvex)
{
    const HingePoints roof = {{0, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, -1, -1}};
    EXPECT_NEAR(hinge_angle(roof), pi / 2, 1e-15);
    const HingePoints gutter = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {0, -1, 1}};
    EXPECT_NEAR(hinge_angle(gutter), -pi / 2, 1e-15);
}

TEST(SpringEnergy, DerivativesMatchDifferencesInEveryRegime)
{
    SpringLaw law;
    law.barrier_ratio = barrier_ratio(1, 1.1);
    const double step = 1e-5;
    for (const double length : {0.05, 0.3, 0.7, 0.76, 0.9, 0.999, 1.001, 1.2, 3.0}) {
        const auto at = [&](double l) { return spring_response(law, 1.0, l); };
        const auto energy = [&](double l) { return at(l).energy + at(l).barrier; };
        EXPECT_NEAR((energy(length + step) - energy(length - step)) / (2 * step), at(length).force, 1e-8);
        EXPECT_NEAR((at(length + step).force - at(length - step).force) / (2 * step), at(length).stiffness, 1e-6);
    }
}

struct Case
{
    double noise;
    double convex_weight;
};

void expect_exact_derivatives(const Case& test, unsigned seed)
{
    Surface surface = shapes::ball_surface(0, {.la = 1, .lb = 1.2, .alpha = 1.05});
    shapes::add_noise(surface, test.noise, seed);
    EmbedOptions options;
    options.convex_weight = test.convex_weight;
    const EmbeddingTerms terms = embedding_terms(surface, {.la = 1, .lb = 1.2, .alpha = 1.05}, options);
    VectorXd x(3 * terms.vertex_count);
    for (const Vertex v : surface.vertices()) {
        x.segment<3>(3 * v.idx()) = surface.point(v);
    }
    VectorXd gradient;
    embedding_gradient(terms, x, gradient);
    HessianPattern pattern;
    BlockMatrix hessian = hessian_matrix(terms, pattern);
    embedding_hessian(terms, pattern, x, {}, hessian);
    VectorXd direction = VectorXd::Random(x.size());
    const double step = 1e-7;
    VectorXd ahead, behind, product;
    const double up = embedding_gradient(terms, x + step * direction, ahead).total();
    const double down = embedding_gradient(terms, x - step * direction, behind).total();
    multiply(hessian, direction, product);
    EXPECT_NEAR((up - down) / (2 * step), gradient.dot(direction), 1e-6 * (1 + gradient.norm()));
    EXPECT_LT(((ahead - behind) / (2 * step) - product).norm(), 1e-5 * (1 + product.norm()));
}

TEST(EmbeddingEnergy, DerivativesMatchDifferencesOnNoisyBalls)
{
    unsigned seed = 0;
    for (const Case test : {Case{0.01, 0}, Case{0.05, 0}, Case{0.05, 1e-3}, Case{0.15, 0}}) {
        for (int k = 0; k < 5; ++k) {
            expect_exact_derivatives(test, ++seed);
        }
    }
}

} // namespace
} // namespace rhombloom
