#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <Eigen/Geometry>

#include "core/design/mesh_import/join_network.h"
#include "core/design/mesh_import/network_bends.h"
#include "core/design/mesh_import/network_moves.h"
#include "core/design/mesh_import/network_trial.h"
#include "core/design/mesh_import/remesh.h"
#include "core/design/mesh_import/working_target.h"
#include "tests/core/design/target_meshes.h"

namespace rhombloom {

namespace {

//! The ball with a limb in triangles of edge 20.
TriangleMesh remeshed_limb()
{
    const MeshTree target(ball_with_limb());
    RemeshOptions options;
    options.edge = 20;
    return remesh(target.mesh(), target, options);
}

} // namespace

TEST(NetworkMoves, AFlipReplacesAnElementASplitAddsThreeACollapseTakesThreeATurnIsUndone)
{
    const TriangleMesh mesh = sphere(100);
    const MeshTree tree(mesh);
    const Plan plan{mesh, triangle_middles(mesh, tree), {}};
    const Corners place = std::minmax(mesh.triangles[7][0], mesh.triangles[7][1]);
    const auto edges = [](const Plan& p) {
        std::set<Corners> result;
        for (const Quad& q : join_network(p.triangles, p.middles).quads) {
            result.insert(std::minmax(q[0], q[2]));
        }
        return result;
    };
    const Plan flipped = carry_out({{Move::Kind::Flip, place}}, plan);
    EXPECT_EQ(edges(flipped).count(place), 0U);
    EXPECT_EQ(edges(flipped).size(), edges(plan).size());
    EXPECT_EQ(edges(carry_out({{Move::Kind::Split, place}}, plan)).size(), edges(plan).size() + 3);
    const Plan fewer = carry_out({{Move::Kind::Collapse, place}}, plan);
    EXPECT_EQ(edges(fewer).size(), edges(plan).size() - 3);
    EXPECT_EQ(fewer.triangles.points.size(), plan.triangles.points.size() - 1);
    EXPECT_EQ(fewer.middles.size(), fewer.triangles.triangles.size());
    const Plan turned = carry_out({{Move::Kind::Turn, place}}, plan);
    EXPECT_EQ(turned.flipped.count(place), 1U);
    EXPECT_TRUE(carry_out({{Move::Kind::Turn, place}}, turned).flipped.empty());
}

TEST(NetworkMoves, ElementsTurnedOverStayTheSameWhenCornersAreRenumbered)
{
    const TriangleMesh mesh = sphere(100);
    const Triangle& last = mesh.triangles.back();
    const Corners turned = std::minmax(last[0], last[1]);
    const Plan plan{mesh, triangle_middles(mesh, MeshTree(mesh)), {turned}};
    const Plan fewer =
        carry_out({{Move::Kind::Collapse, std::minmax(mesh.triangles[0][0], mesh.triangles[0][1])}}, plan);
    ASSERT_EQ(fewer.flipped.size(), 1U);
    const auto [a, b] = *fewer.flipped.begin();
    const std::set<std::array<double, 3>> before = {
        {mesh.points[turned.first].x(), mesh.points[turned.first].y(), 0},
        {mesh.points[turned.second].x(), mesh.points[turned.second].y(), 0}};
    const auto& points = fewer.triangles.points;
    EXPECT_EQ(before,
              (std::set<std::array<double, 3>>{{points[a].x(), points[a].y(), 0}, {points[b].x(), points[b].y(), 0}}));
}

TEST(NetworkMoves, NewCornersAreMeantToBeBetweenThoseAroundThem)
{
    const TriangleMesh mesh = sphere(100);
    Plan plan{mesh, triangle_middles(mesh, MeshTree(mesh)), {}, 1, mesh.points};
    plan.triangles.points.assign(mesh.points.size(), Vec3::Zero()); // wherever they have settled
    const Corners place = std::minmax(mesh.triangles[0][0], mesh.triangles[0][1]);
    const Plan split = carry_out({{Move::Kind::Split, place}}, plan);
    ASSERT_EQ(split.meant.size(), mesh.points.size() + 1);
    const Vec3 middle = (mesh.points[place.first] + mesh.points[place.second]) / 2;
    const double edge = (mesh.points[place.first] - mesh.points[place.second]).norm();
    EXPECT_LT((split.meant.back() - middle).norm(), 0.3 * edge);
    const Plan fewer = carry_out({{Move::Kind::Collapse, place}}, plan);
    EXPECT_EQ(fewer.meant.size(), mesh.points.size() - 1);
    const auto stayed = [&](const Vec3& p) {
        return std::find(mesh.points.begin(), mesh.points.end(), p) != mesh.points.end();
    };
    EXPECT_TRUE(std::all_of(fewer.meant.begin(), fewer.meant.end(), stayed));
}

TEST(NetworkBends, ALimbThatWasTurnedIsBentAtItsRootAlone)
{
    constexpr double root = 200;
    constexpr double reach = 70; // of the corners around that settle how one lies
    const TriangleMesh meant = remeshed_limb();
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(radians(40), Vec3::UnitX()).matrix();
    TriangleMesh settled = meant;
    for (Vec3& p : settled.points) {
        p = p.z() > root ? Vec3(Vec3(0, 0, root) + turn * (p - Vec3(0, 0, root))) : p;
    }
    const std::vector<Eigen::Matrix3d> turned = turns(settled, meant.points);
    for (std::size_t v = 0; v < turned.size(); ++v) {
        const double z = meant.points[v].z();
        if (std::abs(z - root) > reach) {
            EXPECT_LT((turned[v] - (z > root ? turn : Eigen::Matrix3d::Identity())).norm(), 1e-9) << z;
        }
    }
}

TEST(NetworkBends, APoseIsNotAstrayAndADisplacementIsByItsOwnLength)
{
    const TriangleMesh meant = sphere(100);
    std::vector<Vec3> moved;
    for (const Vec3& p : meant.points) {
        moved.emplace_back(2 * (Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()) * p) + Vec3(5, -7, 11));
    }
    EXPECT_LT(astray(moved, meant.points, true).rms, 1e-9);
    EXPECT_NEAR(astray(moved, meant.points, false).rms, 100, 1e-6); // the radius is twice as large
}

TEST(Polish, StraightensALimbThatAFlipHasTurned)
{
    const Element element;
    constexpr double edge = 60; // of triangles on the limb as it was made
    TriangleMesh thick = working_target(ball_with_limb(), edge, 0).thick;
    transform(thick, triangle_edge(element) / edge, Vec3::Zero());
    const MeshTree target(std::move(thick));
    RemeshOptions remeshing;
    remeshing.edge = triangle_edge(element);
    const TriangleMesh triangles = remesh(target.mesh(), target, remeshing);
    SearchOptions options;
    options.elements = static_cast<int>(triangles.triangles.size()) * 3 / 2;
    const Trials trials{target, element, options};
    const Plan plan{triangles, triangle_middles(triangles, target), {}, 1, triangles.points};
    const std::optional<Trial> start = settle(plan, trials);
    ASSERT_TRUE(start);
    std::set<Corners> at_root;
    for (const Triangle& t : triangles.triangles) {
        const double z = triangles.points[t[0]].z() * edge / remeshing.edge;
        for (const Move& move : moves_near(plan, std::minmax(t[0], t[1]), {})) {
            if (move.kind == Move::Kind::Flip && std::abs(z - 110) < 40) {
                at_root.insert(move.corners);
            }
        }
    }
    Trial worst = *start;
    for (const Corners& corners : at_root) {
        auto next = settle(carry_out({{Move::Kind::Flip, corners}}, plan), trials);
        if (next && next->astray > worst.astray) {
            worst = std::move(*next);
        }
    }
    const double added = worst.astray - start->astray;
    ASSERT_GT(added, 0.2);
    polish(worst, trials, Aim::Straight, 1, 6000L * options.elements);
    EXPECT_LT(worst.astray, start->astray + added / 2);
}

} // namespace rhombloom
