#include <gtest/gtest.h>

#include "core/design/mesh_import/mesh_tree.h"
#include "core/design/mesh_import/network_search.h"
#include "core/design/mesh_import/working_target.h"
#include "tests/core/design/target_meshes.h"

namespace rhombloom {

TEST(WorkingTarget, LeavesWhatIsThickEnoughAsItIs)
{
    const WorkingTarget working = working_target(sphere(100), 40, 0);
    EXPECT_EQ(working.thickened, 0);
    EXPECT_EQ(working.scale, 1);
    EXPECT_EQ(working.thick.points.size(), working.even.points.size());
}

TEST(WorkingTarget, ALimbBecomesAsThickAsElementsCanFollow)
{
    constexpr double edge = 100; // the limb's radius is 18
    const WorkingTarget working = working_target(ball_with_limb(), edge, 0);
    EXPECT_GT(working.thickened, 0.05);
    const MeshTree tree(working.thick);
    for (const double z : {200.0, 250.0, 300.0, 350.0}) {
        EXPECT_NEAR(tree.nearest({0, 0, z}).distance, 0.35 * edge, 0.04 * edge) << z;
    }
    EXPECT_NEAR(tree.nearest({0, 0, -100}).distance, 0, 0.04 * edge); // the ball stays
    EXPECT_EQ(working.thick.points.size() - working.thick.triangles.size() / 2, 2U);
}

TEST(WorkingTarget, APlateBecomesACushionThatSoManyElementsCover)
{
    constexpr double edge = 10;
    constexpr int elements = 600;
    const WorkingTarget working = working_target(box({100, 80, 2}), edge, elements);
    EXPECT_GT(working.thickened, 0.9);
    EXPECT_NEAR(MeshTree(working.thick).nearest(working.scale * Vec3(50, 40, 1)).distance, 0.35 * edge, 0.05 * edge);
    EXPECT_NEAR(area(working.thick) / area_per_element(edge), elements, 0.02 * elements);
    EXPECT_NEAR(bounds(working.even).sizes().x(), 100 * working.scale, 0.5);
}

} // namespace rhombloom
