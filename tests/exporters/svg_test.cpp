#include "exporters/svg.h"

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

Path half_disc()
{
    return {{{Vec2(10, 10), 1}, {Vec2(30, 10), 0}}, true};
}

Drawing drawing_of(const Path& path)
{
    return {100, 50, {{"CUT_OUTER", LayerUse::CutOuter, 0xFF0000, {path}}}, {"kerf: <none> & \"such\""}};
}

TEST(Svg, PageIsInMillimetresAndOneUnitIsOne)
{
    const std::string text = svg(drawing_of(half_disc()));
    EXPECT_NE(text.find("width=\"100mm\" height=\"50mm\" viewBox=\"0 0 100 50\""), std::string::npos);
}

TEST(Svg, FlipsYAndTurnsACounterClockwiseArcIntoSweepZero)
{
    // The arc runs below the chord (y up), hence below it on the page too, where y is down.
    EXPECT_NE(svg(drawing_of(half_disc())).find("d=\"M10 40A10 10 0 0 0 30 40Z\""), std::string::npos);
}

TEST(Svg, AnOpenPathIsNotClosed)
{
    Path line = {{{Vec2(1, 2), 0}, {Vec2(3, 4), 0}}, false};
    line.id = "stroke";
    const std::string text = svg(drawing_of(line));
    EXPECT_NE(text.find("<path id=\"stroke\""), std::string::npos);
    EXPECT_NE(text.find("d=\"M1 48L3 46\""), std::string::npos);
}

TEST(Svg, HoldsNothingThatCuttingProgramsTripOver)
{
    const std::string text = svg(drawing_of(half_disc()));
    for (const char* word : {"transform", "<text", "<use", "style", "class=", "clip"}) {
        EXPECT_EQ(text.find(word), std::string::npos) << word;
    }
    EXPECT_NE(text.find("fill=\"none\" stroke=\"#ff0000\" stroke-width=\"0.1\""), std::string::npos);
}

TEST(Svg, EscapesNotes)
{
    EXPECT_NE(svg(drawing_of(half_disc())).find("kerf: &lt;none&gt; &amp; &quot;such&quot;"), std::string::npos);
}

} // namespace
} // namespace rhombloom
