#include "exporters/nesting.h"

#include <gtest/gtest.h>

#include "core/model/element.h"
#include "exporters/outline.h"
#include "tests/exporters/nesting_outlines.h"

namespace rhombloom {
namespace {

using outlines::from_data;
using outlines::rectangle;

NestOptions sheet(double width, double height, double spacing, int count)
{
    NestOptions options;
    options.sheet_width = width;
    options.sheet_height = height;
    options.spacing = spacing;
    options.count = count;
    return options;
}

int placed_copies(const Nesting& nesting)
{
    int sum = 0;
    for (const Sheet& s : nesting.sheets) {
        sum += static_cast<int>(s.placements.size());
    }
    return sum;
}

TEST(Nesting, TwentyEightDefaultElementsShareASheet)
{
    const auto nesting = nest(from_data("nest_default_element.json"), sheet(600, 400, 2, 188));
    ASSERT_TRUE(nesting);
    EXPECT_GE(nesting->per_sheet, 28);
    EXPECT_LE(nesting->sheets.size(), 7U);
    EXPECT_EQ(placed_copies(*nesting), 188);
}

TEST(Nesting, FortyPiecesWithOpenHooksShareASheet)
{
    const auto nesting = nest(from_data("nest_piece_a.json"), sheet(600, 400, 2, 188));
    ASSERT_TRUE(nesting);
    EXPECT_GE(nesting->per_sheet, 40);
    EXPECT_LE(nesting->sheets.size(), 5U);
    EXPECT_EQ(placed_copies(*nesting), 188);
}

TEST(Nesting, MovesAndTurnsAllCopiesWhereNoPatternFits)
{
    const auto u = nest(outlines::u_shape(), sheet(300, 200, 2, 30));
    ASSERT_TRUE(u);
    EXPECT_GE(u->per_sheet, 16);
    const Element large{.la = 100, .lb = 110, .alpha = radians(72), .thickness = 0.8};
    const auto elements = nest(outline_points(hook_parameters(large), 48).value(), sheet(300, 200, 2, 9));
    ASSERT_TRUE(elements);
    EXPECT_GE(elements->per_sheet, 3);
}

TEST(Nesting, LooksForOneMoreOnlyWhereItSavesASheetIfToldSo)
{
    NestOptions options = sheet(300, 200, 2, 30);
    options.effort = Effort::SaveSheets;
    const auto saved = nest(outlines::u_shape(), options);
    ASSERT_TRUE(saved);
    EXPECT_EQ(saved->sheets.size(), 2U);
    EXPECT_EQ(saved->per_sheet, 15);
}

TEST(Nesting, RectanglesFillASheetToTheLastMicrometre)
{
    const auto nesting = nest(rectangle(98, 48), sheet(598, 398, 2, 48));
    ASSERT_TRUE(nesting);
    EXPECT_EQ(nesting->per_sheet, 48);
}

TEST(Nesting, RefusesAPieceLargerThanTheSheetWithTheNumbers)
{
    const auto nesting = nest(rectangle(700, 500), sheet(600, 400, 2, 1));
    ASSERT_FALSE(nesting);
    EXPECT_NE(nesting.error().message.find("700 x 500 mm"), std::string::npos) << nesting.error().message;
    EXPECT_NE(nesting.error().message.find("600 x 400 mm"), std::string::npos) << nesting.error().message;
    EXPECT_EQ(nesting.error().message.find("turn"), std::string::npos) << nesting.error().message;
    NestOptions fixed = sheet(400, 600, 2, 1); // the piece would fit turned
    fixed.grain = Grain::Fixed;
    fixed.margin = 6.374775;
    const std::string refusal = nest(rectangle(500, 300), fixed).error().message;
    EXPECT_NE(refusal.find("a margin of 6.4 mm"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("let the copies turn"), std::string::npos) << refusal;
}

TEST(Nesting, RefusesAnOutlineThatCrossesItself)
{
    EXPECT_FALSE(nest({{0, 0}, {40, 40}, {40, 0}, {0, 40}}, sheet(600, 400, 2, 1)));
}

TEST(Nesting, OutlinesFarFromTheOriginAreNestedAsNearIt)
{
    auto far = outlines::l_shape();
    const Vec2 away(4.5e5, -9e5);
    for (Vec2& p : far) {
        p += away;
    }
    const NestOptions options = sheet(200, 150, 1, 5);
    const auto here = nest(outlines::l_shape(), options), there = nest(far, options);
    ASSERT_TRUE(here && there);
    EXPECT_EQ(here->per_sheet, there->per_sheet);
    for (const Placement& placement : there->sheets.front().placements) {
        for (const Vec2& p : far) {
            const Vec2 q = placed(p, placement);
            EXPECT_TRUE(q.minCoeff() > -1e-6 && q.x() < 200 + 1e-6 && q.y() < 150 + 1e-6) << q.transpose();
        }
    }
}

TEST(Nesting, IsTheSameTwice)
{
    const auto options = sheet(300, 200, 2, 20);
    const auto a = nest(from_data("nest_piece_a.json"), options), b = nest(from_data("nest_piece_a.json"), options);
    ASSERT_TRUE(a && b);
    ASSERT_EQ(a->sheets.size(), b->sheets.size());
    for (std::size_t i = 0; i < a->sheets.size(); ++i) {
        ASSERT_EQ(a->sheets[i].placements.size(), b->sheets[i].placements.size());
        for (std::size_t k = 0; k < a->sheets[i].placements.size(); ++k) {
            EXPECT_EQ(a->sheets[i].placements[k].offset, b->sheets[i].placements[k].offset);
            EXPECT_EQ(a->sheets[i].placements[k].angle, b->sheets[i].placements[k].angle);
        }
    }
}

} // namespace
} // namespace rhombloom
