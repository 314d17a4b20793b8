#include "exporters/coupon.h"

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

const Layer& layer(const Drawing& drawing, LayerUse use)
{
    for (const Layer& l : drawing.layers) {
        if (l.use == use) {
            return l;
        }
    }
    throw std::logic_error("no such layer");
}

TEST(Coupon, HasASquareOfFiftyMillimetresAndAPairPerKerf)
{
    const auto strips = coupon(hook_parameters({}), {});
    ASSERT_TRUE(strips) << strips.error().message;
    const auto& paths = layer(strips->drawing, LayerUse::CutOuter).paths;
    EXPECT_EQ(paths.size(), 1 + 2 * strips->kerfs.size());
    int squares = 0;
    for (const Path& path : paths) {
        EXPECT_TRUE(path.closed);
        if (path.id == "reference-square") {
            const Box box = bounds(path);
            EXPECT_NEAR((box.max - box.min - Vec2(50, 50)).norm(), 0, 1e-9);
            ++squares;
        }
    }
    EXPECT_EQ(squares, 1);
}

TEST(Coupon, LiesWithinTheMarginsOfItsPage)
{
    for (const double la : {40.0, 80.0, 200.0}) {
        Element element;
        element.la = la;
        element.lb = 1.1 * la;
        const auto strips = coupon(hook_parameters(element), {});
        ASSERT_TRUE(strips) << strips.error().message;
        for (const Path& path : layer(strips->drawing, LayerUse::CutOuter).paths) {
            EXPECT_GE(bounds(path).min.minCoeff(), 2.5) << la;
            EXPECT_LE(bounds(path).max.x(), strips->drawing.width - 2.5) << la;
            EXPECT_LE(bounds(path).max.y(), strips->drawing.height - 2.5) << la;
        }
        EXPECT_LE(strips->drawing.width, 600);
        EXPECT_LE(strips->drawing.height, 400);
    }
}

TEST(Coupon, ExplainsItsNotchesAndNamesTheOption)
{
    const auto strips = coupon(hook_parameters({}), {});
    ASSERT_TRUE(strips);
    EXPECT_NE(strips->text.find("1 notch 0 mm"), std::string::npos) << strips->text;
    EXPECT_NE(strips->text.find("--kerf"), std::string::npos);
}

TEST(Coupon, IsRefusedOnASheetTooSmallForIt)
{
    CutOptions options;
    options.sheet_width = options.sheet_height = 52;
    EXPECT_FALSE(coupon(hook_parameters({}), options));
}

} // namespace
} // namespace rhombloom
