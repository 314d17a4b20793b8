#include "exporters/nesting.h"

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rhombloom {
namespace {

std::vector<Vec2> outline_in(const std::string& name)
{
    std::ifstream file(std::string(RHOMBLOOM_SOURCE_DIR "/tests/data/") + name);
    const auto json = nlohmann::json::parse(file);
    std::vector<Vec2> outline;
    for (const auto& p : json.at("outline")) {
        outline.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
    }
    return outline;
}

std::vector<Vec2> rectangle(double width, double height)
{
    return {{0, 0}, {width, 0}, {width, height}, {0, height}};
}

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
    const auto nesting = nest(outline_in("nest_default_element.json"), sheet(600, 400, 2, 188));
    ASSERT_TRUE(nesting);
    EXPECT_GE(nesting->per_sheet, 28);
    EXPECT_LE(nesting->sheets.size(), 7U);
    EXPECT_EQ(placed_copies(*nesting), 188);
}

TEST(Nesting, FortyPiecesWithOpenHooksShareASheet)
{
    const auto nesting = nest(outline_in("nest_piece_a.json"), sheet(600, 400, 2, 188));
    ASSERT_TRUE(nesting);
    EXPECT_GE(nesting->per_sheet, 40);
    EXPECT_LE(nesting->sheets.size(), 5U);
    EXPECT_EQ(placed_copies(*nesting), 188);
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
}

TEST(Nesting, RefusesAnOutlineThatCrossesItself)
{
    EXPECT_FALSE(nest({{0, 0}, {40, 40}, {40, 0}, {0, 40}}, sheet(600, 400, 2, 1)));
}

TEST(Nesting, IsTheSameTwice)
{
    const auto options = sheet(300, 200, 2, 20);
    const auto a = nest(outline_in("nest_piece_a.json"), options), b = nest(outline_in("nest_piece_a.json"), options);
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
