#include "apps/studio/session/pull.h"

#include <gtest/gtest.h>

#include "core/model/validity.h"

namespace rhombloom::studio {
namespace {

Design ball()
{
    Design design;
    design.operations = {Place{"body", "ball-90", Vec3::Zero(), Vec3::Zero()}};
    return design;
}

//! A pull of rhombic-12 from the topmost vertex.
struct Top
{
    Design design = ball();
    SceneCache cache;
    ScenePointer scene = *cache.scene(design);
    PullStart start{"body", 0, "rhombic-12", false};

    Top()
    {
        const Surface& surface = scene->parts.front().surface;
        for (const Vertex v : surface.vertices()) {
            start.vertex = surface.point(v).z() > surface.point(Vertex(start.vertex)).z() ? v.idx() : start.vertex;
        }
    }
};

//! Drag to one place for long enough to settle.
PullFrame hold(Pull& pull, const Vec3& by)
{
    PullFrame frame;
    for (int k = 0; k < 200; ++k) {
        frame = pull.drag(by, 0.02);
    }
    return frame;
}

TEST(Pull, GrowsWithTheDragAndShrinksAgain)
{
    Top top;
    auto pull = Pull::begin(top.scene, top.design, top.start);
    ASSERT_TRUE(pull) << pull.error().message;
    const auto before = top.scene->parts.front().surface.n_faces();
    const PullFrame one = hold(*pull, Vec3(0, 0, 100));
    EXPECT_EQ(one.periods, 1);
    const PullFrame far = hold(*pull, Vec3(0, 0, 330));
    EXPECT_GE(far.periods, 2);
    EXPECT_TRUE(far.settled);
    EXPECT_GT(far.surface->n_faces(), before);
    EXPECT_TRUE(validate(*far.surface, top.design.element).ok());
    const PullFrame back = hold(*pull, Vec3(0, 0, 3));
    EXPECT_EQ(back.periods, 0);
    EXPECT_EQ(back.surface->n_faces(), before);
}

// Longer limbs may differ: the operation chooses among embedded candidates, a frame of a drag has no time for that.
TEST(Pull, ReachesWhatTheOperationMakesInOnePeriod)
{
    Top top;
    auto pull = Pull::begin(top.scene, top.design, top.start);
    ASSERT_TRUE(pull);
    const PullFrame frame = hold(*pull, Vec3(0, 0, 80));
    EXPECT_EQ(frame.periods, 1);
    Design design = top.design;
    Extrude extrude{"", "body", {}, "rhombic-12", Vec3(0, 0, 80)};
    extrude.apex.number = top.start.vertex;
    design.operations.emplace_back(extrude);
    const auto made = top.cache.scene(design);
    ASSERT_TRUE(made) << made.error().reason;
    EXPECT_EQ(frame.surface->n_faces(), (*made)->parts.front().surface.n_faces());
}

TEST(Pull, LeavesTheSceneAlone)
{
    Top top;
    const Surface before = top.scene->parts.front().surface;
    auto pull = Pull::begin(top.scene, top.design, top.start);
    hold(*pull, Vec3(0, 30, 150));
    const Surface& after = top.scene->parts.front().surface;
    ASSERT_EQ(after.n_vertices(), before.n_vertices());
    for (const Vertex v : after.vertices()) {
        EXPECT_EQ(after.point(v), before.point(v));
    }
}

TEST(Pull, RefusesWhatIsNotThere)
{
    Top top;
    EXPECT_FALSE(Pull::begin(top.scene, top.design, {"head", 0, "rhombic-12", false}));
    EXPECT_FALSE(Pull::begin(top.scene, top.design, {"body", 100000, "rhombic-12", false}));
    EXPECT_FALSE(Pull::begin(top.scene, top.design, {"body", 0, "ball-31", false}));
    EXPECT_FALSE(Pull::begin(top.scene, top.design, {"body", 0, "ball-12000", false}));
    EXPECT_FALSE(Pull::begin(top.scene, top.design, {"body", 0, "rhombic-12", true})) << "no symmetry is declared";
}

} // namespace
} // namespace rhombloom::studio
