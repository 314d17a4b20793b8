#include "exporters/coupon.h"

#include <gtest/gtest.h>

#include "exporters/kerf.h"
#include "exporters/segment.h"

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

TEST(Coupon, HasNoSegmentThatLaserProgramsSwallow)
{
    for (const double la : {40.0, 80.0, 200.0}) {
        for (const double alpha : {52.0, 63.435, 79.0}) {
            for (const double kerf : {0.15}) {
                Element element;
                element.la = la;
                element.lb = 1.08 * la;
                element.alpha = radians(alpha);
                element.thickness = la > 100 ? 0.8 : 0.3;
                CutOptions options;
                options.kerf_x = options.kerf_y = kerf;
                const auto strips = coupon(hook_parameters(element), options);
                ASSERT_TRUE(strips) << la << " " << alpha << ": " << strips.error().message;
                EXPECT_EQ(strips->kerfs.size(), 5U) << la << " " << alpha << ": " << strips->warning;
                for (const Path& path : layer(strips->drawing, LayerUse::CutOuter).paths) {
                    EXPECT_TRUE(is_simple(path)) << la << " " << alpha << " " << path.id;
                    for (const Segment& segment : segments(path)) {
                        EXPECT_GE(length(segment), shortest_segment) << la << " " << alpha << " " << path.id;
                    }
                }
            }
        }
    }
}

TEST(Coupon, IsRefusedOnASheetTooSmallForIt)
{
    CutOptions options;
    options.sheet_width = options.sheet_height = 52;
    EXPECT_FALSE(coupon(hook_parameters({}), options));
}

} // namespace
} // namespace rhombloom
