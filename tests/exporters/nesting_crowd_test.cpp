#include "exporters/nesting_crowd.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "exporters/nesting_depth.h"
#include "tests/exporters/nesting_outlines.h"

namespace rhombloom {
namespace {

using namespace nesting;

bool contains(const Polygon& polygon, const Vec2& p)
{
    bool in = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Vec2 &a = polygon[i], &b = polygon[j];
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
            in = !in;
        }
    }
    return in;
}

double distance(const Polygon& polygon, const Vec2& p)
{
    double least = 1e300;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Vec2 ab = polygon[i] - polygon[j];
        const double t = std::clamp((p - polygon[j]).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (p - polygon[j] - t * ab).norm());
    }
    return least;
}

RC_GTEST_PROP(DepthField, IsTheDistanceToTheBoundaryInside, ())
{
    const Polygon polygon = outlines::random_concave(*rc::gen::inRange<std::uint64_t>(1, 200));
    const DepthField field(polygon, 0.5);
    for (int i = 0; i < 200; ++i) {
        const Vec2 p(*rc::gen::inRange(-6000, 6000) / 100.0, *rc::gen::inRange(-6000, 6000) / 100.0);
        const Depth depth = field.at(p);
        const double expected = (contains(polygon, p) ? 1 : -1) * distance(polygon, p);
        if (expected > -0.5) {
            RC_ASSERT(std::abs(depth.depth - expected) < 1e-9);
        } else {
            RC_ASSERT(depth.depth <= -0.5);
        }
    }
}

TEST(DepthField, TheWayOutLowersTheDepth)
{
    const Polygon polygon = outlines::star(5, 40, 17);
    const DepthField field(polygon, 0.5);
    for (const Vec2& p : {Vec2(0.3, 12), Vec2(14, -3), Vec2(-9, 8), Vec2(0.5, 35)}) {
        const Depth depth = field.at(p);
        EXPECT_NEAR(field.at(p + 1e-4 * depth.outward).depth, depth.depth - 1e-4, 1e-9);
    }
}

Piece piece_for(const outlines::Outline& outline, Grain grain)
{
    NestOptions options;
    options.grain = grain;
    return piece_of(outline, options);
}

//! As the search does it: descend, then blame what still overlaps.
bool comes_apart(Crowd& crowd)
{
    for (int round = 0; round < 40; ++round) {
        if (crowd.relax(20)) {
            return true;
        }
        crowd.blame();
    }
    return false;
}

TEST(Crowd, PushesOverlappingCopiesApartWithinTheRoom)
{
    const Piece piece = piece_for(outlines::l_shape(), Grain::Any);
    const Body body(piece);
    // Four boxes of 70 x 60 mm beside each other, disturbed.
    Crowd crowd(body, {152, 132}, {{{40, 36}, 0.1}, {{108, 30}, -0.05}, {{33, 95}, 0.08}, {{107, 99}, 0.02}}, true);
    EXPECT_GT(crowd.energy(), 10);
    EXPECT_TRUE(comes_apart(crowd));
    std::vector<Polygon> copies;
    for (const Pose& pose : crowd.poses()) {
        const Placement at = body.placement(pose);
        Polygon copy = oriented(piece.inflated, {at.angle, at.mirrored});
        for (Vec2& p : copy) {
            p += at.offset;
        }
        for (const Polygon& other : copies) {
            EXPECT_FALSE(boundaries_meet(copy, other));
        }
        copies.push_back(copy);
    }
}

TEST(Crowd, TurnsNothingAgainstTheGrain)
{
    const Piece piece = piece_for(outlines::l_shape(), Grain::Fixed);
    const Body body(piece);
    Crowd crowd(body, {300, 200}, {{{60, 60}, 0}, {{85, 80}, 0}}, false);
    EXPECT_TRUE(comes_apart(crowd));
    for (const Pose& pose : crowd.poses()) {
        EXPECT_EQ(pose.angle, 0);
    }
}

TEST(Body, PosesAndPlacementsAreTheSame)
{
    const Body body(piece_for(outlines::tee(), Grain::Any));
    const Placement placement{1.2, true, Vec2(30, 40)};
    const Placement back = body.placement(body.pose(placement));
    EXPECT_LT((back.offset - placement.offset).norm(), 1e-12);
    EXPECT_EQ(back.angle, placement.angle);
    EXPECT_EQ(back.mirrored, placement.mirrored);
}

} // namespace
} // namespace rhombloom
