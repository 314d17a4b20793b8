#include "exporters/cut_time.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/units.h"

namespace rhombloom {
namespace {

Drawing cut(const Path& path, LayerUse use = LayerUse::CutOuter)
{
    return {100, 100, {{"L", use, 0, {path}}}, {}};
}

constexpr Speeds speeds = {10, 50, 100, 1000, 0.5};

TEST(CutWork, OfALineIsARampUpACruiseAndARampDown)
{
    const Path line = {{{Vec2(0, 0), 0}, {Vec2(20, 0), 0}}, false};
    const CutWork work = cut_work(cut(line), speeds);
    EXPECT_NEAR(work.cut, 20, 1e-12);
    EXPECT_EQ(work.pierces, 1);
    EXPECT_NEAR(work.travel, 20, 1e-12); // back home
    // 0.5 to pierce; 10 mm/s reached in 0.01 s; home at most at 100 mm/s, reached in 0.1 s.
    EXPECT_NEAR(work.seconds, 0.5 + (20.0 / 10 + 0.01) + (20.0 / 100 + 0.1), 1e-9);
}

TEST(CutWork, SlowsDownInTightArcs)
{
    const double r = 0.1; // sqrt(1000 * 0.1) = 10 mm/s, the cutting speed
    const Path wide = {{{Vec2(0, 0), 1}, {Vec2(2 * r, 0), 1}}, true};
    Speeds fast = speeds;
    fast.cut = 1000;
    const double slow = cut_work(cut(wide), speeds).seconds;
    EXPECT_NEAR(cut_work(cut(wide), fast).seconds, slow, 1e-9);
    EXPECT_NEAR(cut_work(cut(wide), speeds).cut, two_pi * r, 1e-12);
}

// Both ways are 20 mm long and end 0 mm and 20 mm from home; only the way itself is compared.
TEST(CutWork, StopsAtCornersButNotWhereTangentsAgree)
{
    const Path straight = {{{Vec2(0, 0), 0}, {Vec2(10, 0), 0}, {Vec2(20, 0), 0}}, false};
    const Path bent = {{{Vec2(0, 0), 0}, {Vec2(10, 0), 0}, {Vec2(10, 10), 0}}, false};
    const Path rounded = {{{Vec2(0, 0), 0}, {Vec2(7, 0), std::tan(pi / 8)}, {Vec2(10, 3), 0}, {Vec2(10, 10), 0}},
                          false};
    const auto delay = [](const Path& path) {
        Speeds slow = speeds; // so slow that the way home is a long cruise
        slow.travel = 10;
        const CutWork work = cut_work(cut(path), slow);
        return work.seconds - slow.pierce - work.cut / slow.cut - (work.travel / slow.travel + 0.01);
    };
    EXPECT_NEAR(delay(straight), 0.01, 1e-9);
    EXPECT_NEAR(delay(rounded), 0.01, 1e-9);
    EXPECT_NEAR(delay(bent), 0.02, 1e-9);
}

TEST(CutWork, DoesNotCountBorderAndReference)
{
    const Path line = {{{Vec2(0, 0), 0}, {Vec2(20, 0), 0}}, false};
    for (const LayerUse use : {LayerUse::Sheet, LayerUse::Reference}) {
        const CutWork work = cut_work(cut(line, use), speeds);
        EXPECT_EQ(work.pierces, 0);
        EXPECT_EQ(work.seconds, 0);
    }
    EXPECT_NEAR(cut_work(cut(line, LayerUse::Engrave), speeds).engrave, 20, 1e-12);
}

} // namespace
} // namespace rhombloom
