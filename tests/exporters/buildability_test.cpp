#include "exporters/buildability.h"

#include <gtest/gtest.h>

#include "core/design/design_file.h"

namespace rhombloom {
namespace {

//! A ball blown up by 2 %.
Buildability judged(double stretch_limit)
{
    const auto design =
        parse_design(R"({"rhombloom": 1, "operations": [{"op": "place", "id": "balloon", "shape": "ball-30"}]})");
    EXPECT_TRUE(design) << design.error().message;
    auto replayed = replay(*design);
    auto piece = make_piece(design->element, std::nullopt, {});
    EXPECT_TRUE(replayed && piece);
    for (const Vertex v : replayed->surface.vertices()) {
        replayed->surface.set_point(v, 1.02 * replayed->surface.point(v));
    }
    replayed->embedding.max_stretch = 1.02 * (1 + replayed->embedding.max_stretch) - 1;
    piece->stretch_limit = stretch_limit;
    return buildability(*replayed, *piece);
}

TEST(Buildability, NamesTheElementsThatStretchTooFar)
{
    const Buildability report = judged(usual_stretch_limit);
    ASSERT_FALSE(report.ok());
    const std::string& problem = report.problems.front();
    EXPECT_NE(problem.find("possible is 1 %"), std::string::npos) << problem;
    EXPECT_NE(problem.find("30 elements, most of all "), std::string::npos) << problem;
    EXPECT_NE(problem.find("in \"balloon\""), std::string::npos) << problem;
}

TEST(Buildability, LetsMoreStretchPassWithAWarningWhenItIsAllowed)
{
    EXPECT_FALSE(judged(0.02).ok());
    const Buildability report = judged(0.03);
    EXPECT_TRUE(report.ok());
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_NE(report.warnings.front().find("a usual sheet gives 1 %"), std::string::npos) << report.warnings.front();
}

TEST(Buildability, TellsWhichElementCollapsesMost)
{
    const auto design =
        parse_design(R"({"rhombloom": 1, "operations": [{"op": "place", "id": "tile", "shape": "sheet-1x1"}]})");
    ASSERT_TRUE(design) << design.error().message;
    auto replayed = replay(*design);
    const auto piece = make_piece(design->element, std::nullopt, {});
    ASSERT_TRUE(replayed && piece);
    EXPECT_TRUE(buildability(*replayed, *piece).warnings.empty());
    for (const Vertex v : replayed->surface.vertices()) {
        replayed->surface.set_point(v, 0.6 * replayed->surface.point(v));
    }
    EXPECT_NEAR(element_compression(replayed->surface, design->element, Face(0)), 0.4, 1e-6);
    replayed->embedding.message = "elements collapse";
    const Buildability report = buildability(*replayed, *piece);
    EXPECT_TRUE(report.ok());
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_NE(report.warnings.front().find("element 0 in \"tile\", pressed together to 60 %"), std::string::npos)
        << report.warnings.front();
}

} // namespace
} // namespace rhombloom
