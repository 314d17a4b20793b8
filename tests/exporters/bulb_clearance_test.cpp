#include "exporters/bulb_clearance.h"

#include <random>

#include <gtest/gtest.h>

#include "core/model/base_shapes.h"

namespace rhombloom {

namespace {

double uniform(std::mt19937& random)
{
    return 2 * (random() / 4294967296.0) - 1;
}

Vec3 random_point(std::mt19937& random)
{
    const double x = uniform(random);
    const double y = uniform(random);
    return {x, y, uniform(random)};
}

//! Smallest distance over a fine grid of both.
double sampled_distance(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t)
{
    double nearest = 1e300;
    constexpr int n = 60;
    for (int i = 0; i <= n; ++i) {
        const Vec3 p = a + (b - a) * i / n;
        for (int j = 0; j <= n; ++j) {
            for (int k = 0; j + k <= n; ++k) {
                const Vec3 q = t[0] + (t[1] - t[0]) * j / n + (t[2] - t[0]) * k / n;
                nearest = std::min(nearest, (p - q).norm());
            }
        }
    }
    return nearest;
}

} // namespace

TEST(BulbClearance, SegmentAndTriangleAgreeWithDenseSampling)
{
    std::mt19937 random(7);
    for (int run = 0; run < 150; ++run) {
        const Vec3 a = random_point(random);
        const Vec3 b = random_point(random);
        const std::array<Vec3, 3> t = {random_point(random), random_point(random), random_point(random)};
        const double exact = segment_triangle_distance(a, b, t);
        const double sampled = sampled_distance(a, b, t);
        EXPECT_LE(exact, sampled + 1e-12) << run;
        EXPECT_GE(exact, sampled - 0.06) << run;
    }
}

TEST(BulbClearance, ABulbInTheMiddleOfACubeHasHalfItsRoom)
{
    Element element;
    SurfaceLists cube;
    for (int i = 0; i < 8; ++i) {
        cube.positions.emplace_back(i & 1 ? 100 : -100, i & 2 ? 100 : -100, i & 4 ? 100 : -100);
        cube.sides.push_back((i & 1) ^ ((i >> 1) & 1) ^ ((i >> 2) & 1) ? Side::Long : Side::Short);
    }
    cube.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    cube.facing.assign(6, Facing::Front);
    cube.component.assign(6, 0);
    cube.serial = {0, 1, 2, 3, 4, 5};
    const Surface surface = *make_surface(cube);
    const Bulb bulb{"A60", 60, 110};
    EXPECT_NEAR(bulb_clearance(surface, bulb, {{0, 0, 55}, {0, 0, -1}}), 45, 1e-9);
    EXPECT_NEAR(bulb_clearance(surface, bulb, {{0, 0, 100}, {0, 0, -1}}), 0, 1e-9);
    EXPECT_NEAR(bulb_clearance(surface, bulb, {{0, 0, 150}, {0, 0, -1}}), -30, 1e-9);
    EXPECT_NEAR(bulb_clearance(surface, bulb, {{65, 0, 55}, {0, 0, -1}}), 5, 1e-9);
}

TEST(BulbClearance, TheBallOfThirtyHoldsASmallGlobe)
{
    const auto ball = base_shape("ball-30", Element{});
    ASSERT_TRUE(ball) << ball.error().message;
    const Bulb globe = common_bulbs()[1];
    EXPECT_EQ(globe.name, "G95");
    const double clearance = bulb_clearance(ball->surface, globe, {{0, 0, globe.length / 2}, {0, 0, -1}});
    EXPECT_GT(clearance, 20);
    EXPECT_LT(clearance, 80);
}

TEST(BulbClearance, TellsWhichBulbsHaveRoomInTheMiddle)
{
    const auto fits = bulbs_in_middle(base_shape("ball-30", Element{.la = 80, .lb = 88})->surface);
    ASSERT_EQ(fits.size(), common_bulbs().size());
    for (const BulbFit& f : fits) {
        // The ball's inner radius is about 1.4 la: what the capsule leaves of it.
        EXPECT_NEAR(f.clearance, 110 - 0.5 * f.bulb.length, 15) << f.bulb.name;
        EXPECT_NE(bulbs_text(fits).find(f.bulb.name), std::string::npos);
    }
    EXPECT_TRUE(bulbs_in_middle(base_shape("torus-12x6", Element{})->surface).empty());
    EXPECT_EQ(bulbs_text({}), "");
}

} // namespace rhombloom
