#include "exporters/crop.h"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/units.h"

namespace rhombloom {
namespace {

Path disc(double radius)
{
    return {{{Vec2(radius, 0), 1}, {Vec2(-radius, 0), 1}}, true};
}

Path rectangle(double width, double height)
{
    return {{{Vec2(0, 0), 0}, {Vec2(width, 0), 0}, {Vec2(width, height), 0}, {Vec2(0, height), 0}}, true};
}

TEST(Cropped, HalfADiscIsHalfADisc)
{
    for (const double angle : {0.0, 0.3, 1.0, 2.5, 4.0}) {
        const auto half = cropped(disc(10), {Vec2::Zero(), Vec2(std::cos(angle), std::sin(angle))});
        ASSERT_TRUE(half) << angle;
        EXPECT_NEAR(area(*half), 50 * pi, 1e-9) << angle;
    }
}

TEST(Cropped, KeepsTheLeft)
{
    const auto part = cropped(rectangle(10, 4), {Vec2(3, 0), Vec2::UnitY()});
    ASSERT_TRUE(part);
    EXPECT_NEAR(area(*part), 12, 1e-12);
    EXPECT_NEAR(bounds(*part).max.x(), 3, 1e-12);
}

TEST(Cropped, TheCutEdgeIsTheLastSegment)
{
    const auto part = cropped(rectangle(10, 4), {Vec2(3, 0), Vec2::UnitY()});
    ASSERT_TRUE(part);
    EXPECT_NEAR(part->vertices.back().point.x(), 3, 1e-12);
    EXPECT_NEAR(part->vertices.front().point.x(), 3, 1e-12);
}

TEST(Cropped, ASegmentOfADiscHasTheAreaOfTheFormula)
{
    const double h = 6; // over the centre
    const auto cap = cropped(disc(10), {Vec2(0, h), Vec2::UnitX()});
    ASSERT_TRUE(cap);
    EXPECT_NEAR(area(*cap), 100 * std::acos(h / 10) - h * std::sqrt(100 - h * h), 1e-9);
}

TEST(Cropped, IsRefusedWhereTheLineMissesOrCrossesFourTimes)
{
    EXPECT_FALSE(cropped(disc(10), {Vec2(0, 11), Vec2::UnitX()}));
    const Path u = {{{Vec2(0, 0), 0},
                     {Vec2(30, 0), 0},
                     {Vec2(30, 20), 0},
                     {Vec2(20, 20), 0},
                     {Vec2(20, 10), 0},
                     {Vec2(10, 10), 0},
                     {Vec2(10, 20), 0},
                     {Vec2(0, 20), 0}},
                    true};
    EXPECT_FALSE(cropped(u, {Vec2(0, 15), Vec2::UnitX()}));
    EXPECT_FALSE(cropped(u, {Vec2(0, 15), -Vec2::UnitX()}));
    EXPECT_TRUE(cropped(u, {Vec2(0, 5), -Vec2::UnitX()}));
}

// Both sides of any line together are the whole.
RC_GTEST_PROP(Cropped, BothPartsAddUp, ())
{
    const double angle = *rc::gen::inRange(0, 6283) / 1000.0;
    const double offset = *rc::gen::inRange(-900, 900) / 100.0;
    const Vec2 along(std::cos(angle), std::sin(angle));
    const Vec2 point = offset * Vec2(-along.y(), along.x());
    const auto left = cropped(disc(10), {point, along});
    const auto right = cropped(disc(10), {point, -along});
    RC_ASSERT(left.has_value() && right.has_value());
    RC_ASSERT(std::abs(area(*left) + area(*right) - 100 * pi) < 1e-8);
}

TEST(Notched, CutsTrianglesOutOfTheLastEdge)
{
    const Path strip = rectangle(10, 40); // the last edge runs down along x = 0
    const Path marked = notched(strip, 3, 2);
    EXPECT_EQ(marked.vertices.size(), strip.vertices.size() + 9);
    EXPECT_NEAR(area(strip) - area(marked), 3 * 2 * 1.5 / 2, 1e-12);
    EXPECT_NEAR(bounds(marked).min.x(), 0, 1e-12);
}

} // namespace
} // namespace rhombloom
