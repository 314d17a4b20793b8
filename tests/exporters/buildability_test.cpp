#include "exporters/buildability.h"

#include <gtest/gtest.h>

#include "core/design/design_file.h"

namespace rhombloom {
namespace {

Buildability judged(const std::string& shape, double stretch_limit)
{
    const auto design =
        parse_design(R"({"rhombloom": 1, "operations": [{"op": "place", "id": "ring", "shape": ")" + shape + R"("}]})");
    EXPECT_TRUE(design) << design.error().message;
    const auto replayed = replay(*design);
    auto piece = make_piece(design->element, std::nullopt, {});
    EXPECT_TRUE(replayed && piece);
    piece->stretch_limit = stretch_limit;
    return buildability(*replayed, *piece);
}

// torus-6x6 stretches by 5.9 %.
TEST(Buildability, NamesTheElementThatStretchesTooFar)
{
    const Buildability report = judged("torus-6x6", usual_stretch_limit);
    ASSERT_FALSE(report.ok());
    EXPECT_NE(report.problems.front().find("possible is 1 %"), std::string::npos) << report.problems.front();
    EXPECT_NE(report.problems.front().find("in \"ring\""), std::string::npos) << report.problems.front();
}

TEST(Buildability, LetsMoreStretchPassWithAWarningWhenItIsAllowed)
{
    EXPECT_FALSE(judged("torus-6x6", 0.05).ok());
    const Buildability report = judged("torus-6x6", 0.06);
    EXPECT_TRUE(report.ok());
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_NE(report.warnings.front().find("a usual sheet gives 1 %"), std::string::npos) << report.warnings.front();
    EXPECT_TRUE(judged("ball-30", usual_stretch_limit).warnings.empty());
}

} // namespace
} // namespace rhombloom
