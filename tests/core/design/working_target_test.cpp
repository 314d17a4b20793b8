#include <gtest/gtest.h>

#include "core/design/mesh_import/mesh_tree.h"
#include "core/design/mesh_import/network_search.h"
#include "core/design/mesh_import/working_target.h"
#include "tests/core/design/target_meshes.h"

namespace rhombloom {

namespace {

//! A box of 100 x 60 x 80 with a slot of that width and depth 60 from above.
TriangleMesh box_with_slot(double width)
{
    const double a = 50 - width / 2;
    const double b = 50 + width / 2;
    const std::vector<std::pair<double, double>> outline = {{0, 0},  {100, 0}, {100, 80}, {b, 80},
                                                            {b, 20}, {a, 20},  {a, 80},   {0, 80}};
    const int corners = static_cast<int>(outline.size());
    TriangleMesh mesh;
    for (const double y : {0.0, 60.0}) {
        for (const auto& [x, z] : outline) {
            mesh.points.emplace_back(x, y, z);
        }
    }
    for (const Triangle& t : std::vector<Triangle>{{0, 1, 4}, {0, 4, 5}, {1, 2, 4}, {2, 3, 4}, {0, 5, 7}, {5, 6, 7}}) {
        mesh.triangles.push_back(t);
        mesh.triangles.push_back({t[0] + corners, t[2] + corners, t[1] + corners});
    }
    for (int k = 0; k < corners; ++k) {
        const int n = (k + 1) % corners;
        mesh.triangles.push_back({k, k + corners, n});
        mesh.triangles.push_back({n, k + corners, n + corners});
    }
    return mesh;
}

} // namespace

TEST(WorkingTarget, ANarrowSlotIsFilledAWideOneStaysOpen)
{
    constexpr double edge = 20; // the narrowest gap is 9
    const auto is_inside = [](const TriangleMesh& mesh, const Vec3& p) {
        return MeshTree(mesh).winding_number(p) > 0.5;
    };
    const WorkingTarget narrow = working_target(box_with_slot(6), edge, 0);
    const WorkingTarget wide = working_target(box_with_slot(30), edge, 0);
    EXPECT_GT(narrow.filled, 0.1);
    EXPECT_EQ(wide.filled, 0);
    for (const double z : {30.0, 50.0, 70.0}) {
        EXPECT_TRUE(is_inside(narrow.thick, {50, 30, z}));
        EXPECT_FALSE(is_inside(narrow.even, {50, 30, z})); // what distances are measured from
        EXPECT_FALSE(is_inside(wide.thick, {50, 30, z}));
    }
    const MeshTree outside(narrow.thick);
    for (const Vec3& p : {Vec3(0, 30, 40), Vec3(100, 30, 40), Vec3(50, 30, 0), Vec3(25, 0, 40), Vec3(75, 60, 40)}) {
        EXPECT_LT(outside.nearest(p).distance, 0.05 * edge);
    }
}

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
