#include "core/form/embedding.h"

#include <gtest/gtest.h>

#include "core/model/base_shapes.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom {
namespace {

TEST(Embedding, FindsTheThirtyBallOfTheDesign)
{
    Surface surface = shapes::ball_surface(0);
    const EmbedReport report = embed(surface, {});
    EXPECT_TRUE(report.converged) << report.message;
    EXPECT_NEAR(report.spring_energy, 58.4927, 5e-5);
    EXPECT_EQ(report.concavity_energy, 0);
    EXPECT_NEAR(report.max_stretch, 0.00153, 5e-6);
    EXPECT_LE(report.gradient_norm, 1e-9);
}

TEST(Embedding, ConvergesOnEveryShapeOfTheLibrary)
{
    const Element element;
    for (const std::string& name : base_shape_names()) {
        Surface surface = base_shape(name, element).value().surface;
        const EmbedReport report = embed(surface, element);
        EXPECT_TRUE(report.converged) << name << ": " << report.message << ", gradient " << report.gradient_norm;
        std::printf(
            "%-14s %6zu elements %4d iterations, energy %10.4f mm (concavity %.4f), gradient %.1e, stretch %.5f\n",
            name.c_str(), surface.n_faces(), report.iterations, report.energy, report.concavity_energy,
            report.gradient_norm, report.max_stretch);
    }
}

} // namespace
} // namespace rhombloom
