#include "core/form/term_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/form/embedding_energy.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom {
namespace {

TEST(PortableAtan2, AgreesWithTheCLibrary)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < 100000; ++k) {
        const double y = uniform(random);
        const double x = uniform(random);
        const double expected = std::atan2(y, x);
        EXPECT_NEAR(portable_atan2(y, x), expected, 4.5e-16 * (1 + std::abs(expected)));
    }
    EXPECT_EQ(portable_atan2(0, 0), 0);
    EXPECT_NEAR(portable_atan2(0, -1), std::acos(-1.0), 1e-15);
}

struct Sum
{
    double energy = 0;
    double guard = 0;
};

// The energy term by term from the functions of one term.
Sum plain_sum(const EmbeddingTerms& terms, const Eigen::VectorXd& x)
{
    Sum sum;
    const auto at = [&](int v) { return Vec3(x.segment<3>(3 * v)); };
    for (const SpringPair& pair : terms.springs) {
        for (int k = 0; k < pair.count; ++k) {
            const SpringResponse one =
                spring_response(terms.spring_law, pair.rest[k], (at(pair.b) - at(pair.a)).norm());
            sum.energy += one.energy;
            sum.guard += one.barrier;
        }
    }
    for (const HingeVertices& h : terms.hinges) {
        const HingeResponse one =
            hinge_response(terms.hinge_law, hinge_angle({at(h[0]), at(h[1]), at(h[2]), at(h[3])}));
        sum.energy += one.energy;
        sum.guard += one.ridge;
    }
    return sum;
}

TEST(TermKernels, SumTheSameAsTermByTerm)
{
    for (const double convex_weight : {0.0, 1e-3}) {
        for (const double noise : {1.0, 20.0, 60.0}) {
            Surface surface = shapes::ball_surface(1);
            shapes::add_noise(surface, noise, 7);
            EmbedOptions options;
            options.convex_weight = convex_weight;
            const EmbeddingTerms terms = embedding_terms(surface, {}, options);
            Eigen::VectorXd x(3 * terms.vertex_count);
            for (const Vertex v : surface.vertices()) {
                x.segment<3>(3 * v.idx()) = surface.point(v) / terms.la;
            }
            const EnergyParts parts = embedding_energy(terms, x);
            const Sum expected = plain_sum(terms, x);
            EXPECT_NEAR(parts.spring + parts.concavity, expected.energy, 1e-12 * expected.energy);
            EXPECT_NEAR(parts.guard, expected.guard, 1e-12 * (1 + expected.guard));
        }
    }
}

} // namespace
} // namespace rhombloom
