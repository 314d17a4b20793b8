#include <gtest/gtest.h>

#include "core/design/history.h"
#include "core/form/connectivity_start.h"
#include "core/form/embedding.h"
#include "core/form/inflate.h"
#include "core/form/start_shape.h"
#include "core/model/base_shapes.h"
#include "tests/bench/examples.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom {
namespace {

Surface noisy(Surface surface, double sigma, unsigned seed)
{
    shapes::add_noise(surface, sigma, seed);
    return surface;
}

Surface cloud(Surface surface, double sigma, unsigned seed)
{
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, Vec3::Zero());
    }
    return noisy(std::move(surface), sigma, seed);
}

Eigen::VectorXd positions(const Surface& surface, double la)
{
    Eigen::VectorXd x(3 * surface.n_vertices());
    for (const Vertex v : surface.vertices()) {
        x.segment<3>(3 * v.idx()) = surface.point(v) / la;
    }
    return x;
}

double mean_angle(const EmbeddingTerms& terms, const Eigen::VectorXd& x)
{
    double sum = 0;
    for (const HingeVertices& h : terms.hinges) {
        sum += hinge_angle(
            {x.segment<3>(3 * h[0]), x.segment<3>(3 * h[1]), x.segment<3>(3 * h[2]), x.segment<3>(3 * h[3])});
    }
    return sum / double(terms.hinges.size());
}

void expect_energy(Surface surface, double energy, const char* start)
{
    const EmbedReport report = embed(surface, {});
    EXPECT_TRUE(report.converged) << start << ": " << report.message;
    EXPECT_NEAR(report.energy, energy, 1e-6 * energy) << start;
}

// From noise its head tilts another way than from where the design leaves it; a cloud turns half of it inside out.
TEST(UnknownStart, FindsTheSnakeWhateverTheStart)
{
    const Surface snake = replay(bench::example("snake")).value().surface;
    const double energy = measure(snake, {}).energy;
    expect_energy(noisy(snake, 40, 2), energy, "noise");
    expect_energy(cloud(snake, 150, 1), energy, "cloud");
    expect_energy(cloud(snake, 150, 2), energy, "another cloud");
}

// Its corners bend up along one diagonal or the other, and these equilibria differ by less than a hundredth.
TEST(UnknownStart, BendsASheetTheSameWayFromAnyNoise)
{
    const Surface sheet = base_shape("sheet-4x4", {}).value().surface;
    Surface settled = sheet;
    const double energy = embed(settled, {}).energy;
    for (const unsigned seed : {2, 4, 6, 10}) {
        expect_energy(noisy(sheet, 8, seed), energy, "noise");
    }
}

TEST(UnknownStart, IsDisorderedWithNoiseButNotAfterAnEdit)
{
    Surface ball = shapes::ball_surface(1);
    embed(ball, {});
    const EmbeddingTerms terms = embedding_terms(ball, {}, {});
    EXPECT_TRUE(is_disordered(terms, positions(noisy(ball, 8, 1), 80)));
    EXPECT_FALSE(is_disordered(terms, positions(ball, 80)));
    EXPECT_FALSE(knows_nothing(terms, positions(noisy(ball, 40, 1), 80)));
    EXPECT_TRUE(knows_nothing(terms, positions(cloud(ball, 150, 1), 80)));
    ball.set_point(Vertex(3), ball.point(Vertex(3)) + Vec3(60, 0, 0));
    EXPECT_FALSE(is_disordered(terms, positions(ball, 80)));
}

TEST(Inflate, BringsWhatIsInsideOutThroughItself)
{
    Surface ball = shapes::ball_surface(1);
    embed(ball, {});
    const EmbeddingTerms terms = embedding_terms(ball, {}, {});
    Eigen::VectorXd x = -positions(ball, 80);
    ASSERT_LT(mean_angle(terms, x), -0.2);
    inflate(terms, std::vector<bool>(ball.n_vertices(), true), 0.15, x);
    EXPECT_GT(mean_angle(terms, x), 0.2);
}

TEST(StretchFilm, LaysTheFreeVerticesBetweenTheOthers)
{
    Surface ball = shapes::ball_surface(1);
    const EmbeddingTerms terms = embedding_terms(ball, {}, {});
    const Eigen::VectorXd before = positions(ball, 80);
    Eigen::VectorXd x = before;
    std::vector<bool> is_free(ball.n_vertices(), false);
    is_free[5] = true;
    stretch_film(terms, is_free, x);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    const std::vector<int> neighbours = spring_neighbours(terms)[5];
    for (const int w : neighbours) {
        mean += before.segment<3>(3 * w) / double(neighbours.size());
    }
    EXPECT_LT((x.segment<3>(15) - mean).norm(), 1e-12);
    x.segment<3>(15) = before.segment<3>(15);
    EXPECT_EQ(x, before);
}

} // namespace
} // namespace rhombloom
