#include "exporters/strokes.h"

#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

constexpr std::string_view all_glyphs = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ/.-:%+x=";

TEST(Strokes, EveryGlyphHasAtMostSixOpenStrokesWithinItsBox)
{
    for (const char glyph : all_glyphs) {
        const auto paths = strokes(std::string_view(&glyph, 1), 6);
        EXPECT_GE(paths.size(), 1U) << glyph;
        EXPECT_LE(paths.size(), 6U) << glyph;
        for (const Path& path : paths) {
            EXPECT_FALSE(path.closed) << glyph;
            EXPECT_GE(path.vertices.size(), 2U) << glyph;
            const Box box = bounds(path);
            EXPECT_GE(box.min.minCoeff(), -1e-9) << glyph;
            EXPECT_LE(box.max.x(), 4 + 1e-9) << glyph;
            EXPECT_LE(box.max.y(), 6 + 1e-9) << glyph;
        }
    }
}

// The same segment twice would be burnt twice.
TEST(Strokes, NoSegmentIsDrawnTwice)
{
    using Segment = std::tuple<double, double, double, double, double>;
    for (const char glyph : all_glyphs) {
        std::set<Segment> seen;
        for (const Path& path : strokes(std::string_view(&glyph, 1), 6)) {
            for (std::size_t i = 0; i + 1 < path.vertices.size(); ++i) {
                const Vec2& a = path.vertices[i].point;
                const Vec2& b = path.vertices[i + 1].point;
                const double bulge = path.vertices[i].bulge;
                EXPECT_GE((b - a).norm(), 0.5) << glyph;
                EXPECT_TRUE(seen.insert({a.x(), a.y(), b.x(), b.y(), bulge}).second) << glyph;
                EXPECT_EQ(seen.count({b.x(), b.y(), a.x(), a.y(), -bulge}), 0U) << glyph;
            }
        }
    }
}

TEST(Strokes, SixAndNineAreUnderlinedWhenPiecesCanBeTurned)
{
    EXPECT_EQ(strokes("69", 5, SixNine::Underlined).size(), strokes("69", 5).size() + 2);
    EXPECT_EQ(strokes("80", 5, SixNine::Underlined).size(), strokes("80", 5).size());
    EXPECT_LT(bounds(strokes("6", 5, SixNine::Underlined).back()).max.y(), 0);
}

TEST(Strokes, WidthIsThatOfTheWidestLetters)
{
    double right = 0;
    for (const Path& path : strokes("1040", 5)) {
        right = std::max(right, bounds(path).max.x());
    }
    EXPECT_NEAR(strokes_width("1040", 5), right, 1e-9);
    EXPECT_EQ(strokes_width("", 5), 0);
}

TEST(Strokes, UnknownCharactersAreGaps)
{
    EXPECT_TRUE(strokes("\xc3\xa9 #", 5).empty());
}

} // namespace
} // namespace rhombloom
