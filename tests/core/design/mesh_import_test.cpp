#include <gtest/gtest.h>

#include "core/design/design_file.h"
#include "core/design/history.h"
#include "core/design/mesh_import/curvature_match.h"
#include "core/design/mesh_import/import_warning.h"
#include "core/design/mesh_import/join_network.h"
#include "core/design/mesh_import/mesh_decimate.h"
#include "core/design/mesh_import/mesh_import.h"
#include "core/design/mesh_import/mesh_repair.h"
#include "core/design/mesh_import/mesh_wrap.h"
#include "core/design/mesh_import/network_search.h"
#include "core/design/mesh_import/remesh.h"
#include "core/model/validity.h"
#include "tests/core/design/target_meshes.h"

namespace rhombloom {

namespace {

//! From the network of \p triangles; the middles of its triangles lie in their planes.
Surface flat_join(const TriangleMesh& triangles)
{
    std::vector<Vec3> middles;
    for (const Triangle& t : triangles.triangles) {
        middles.emplace_back((triangles.points[t[0]] + triangles.points[t[1]] + triangles.points[t[2]]) / 3);
    }
    auto surface = make_surface(join_network(triangles, middles));
    EXPECT_TRUE(surface) << (surface ? "" : surface.error().message);
    return std::move(*surface);
}

ImportedMesh imported_ball()
{
    ImportOptions options;
    options.size.elements = 120;
    auto made = import_mesh(sphere(50), options);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return std::move(*made);
}

const ImportedMesh& same_ball()
{
    static const ImportedMesh ball = imported_ball();
    return ball;
}

} // namespace

TEST(MeshTree, NearestPointIsThatOfTheNearestTriangle)
{
    const MeshTree tree(sphere(1));
    for (const Vec3& p : {Vec3(2, 1, 0.5), Vec3(0.1, -0.2, 0.3), Vec3(-1, 3, -2)}) {
        double best = 1e9;
        for (const Triangle& t : tree.mesh().triangles) {
            const auto& q = tree.mesh().points;
            best = std::min(best, (nearest_on_triangle(p, q[t[0]], q[t[1]], q[t[2]]) - p).norm());
        }
        EXPECT_DOUBLE_EQ(tree.nearest(p).distance, best);
        for (const int hint : {0, tree.nearest(p).triangle}) {
            EXPECT_DOUBLE_EQ(tree.nearest(p, hint).distance, best);
        }
    }
}

TEST(MeshTree, WindingNumberTellsInsideFromOutside)
{
    const MeshTree tree(sphere(1));
    EXPECT_NEAR(tree.winding_number({0.3, 0.2, -0.4}), 1, 0.02);
    EXPECT_NEAR(tree.winding_number({0.3, 1.2, -0.4}), 0, 0.02);
}

TEST(MeshCurvature, SumsToFourPiOnASphere)
{
    double sum = 0;
    for (const double k : point_curvature(sphere(3))) {
        sum += k;
    }
    EXPECT_NEAR(sum, 4 * pi, 1e-9);
}

TEST(JoinNetwork, HasOneElementPerEdgeAndSidesThatAlternate)
{
    const TriangleMesh mesh = sphere(100);
    const MeshTree tree(mesh);
    const auto surface = make_surface(join_network(mesh, triangle_middles(mesh, tree)));
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->n_faces(), mesh.triangles.size() * 3 / 2);
    EXPECT_TRUE(validate(*surface, Element{}).ok());
}

TEST(Remesh, MeetsTheNumberOfEdgesAndKeepsTheGenus)
{
    const MeshTree tree(sphere(100));
    RemeshOptions options;
    options.edge = 60;
    const TriangleMesh mesh = with_edge_count(remesh(tree.mesh(), tree, options), tree, 150, options);
    EXPECT_NEAR(1.5 * static_cast<double>(mesh.triangles.size()), 150, 2);
    EXPECT_EQ(mesh.points.size() - mesh.triangles.size() / 2, 2U);
}

TEST(Remesh, KeepsALimbThinnerThanAnEdge)
{
    const MeshTree tree(ball_with_limb());
    RemeshOptions options;
    options.edge = 60;
    EXPECT_GT(bounds(remesh(tree.mesh(), tree, options)).max().z(), 370);
}

TEST(Fit, ALimbThatPointsElsewhereDoesNotShrinkTheSurface)
{
    const MeshTree target(ball_with_limb());
    RemeshOptions options;
    options.edge = 20;
    TriangleMesh bent = remesh(target.mesh(), target, options);
    const Vec3 root(0, 0, 90);
    const Eigen::AngleAxisd turn(radians(90), Vec3::UnitX());
    for (Vec3& p : bent.points) {
        p = p.z() > root.z() ? Vec3(root + turn * (p - root)) : p;
    }
    const Eigen::Affine3d pose = fit(flat_join(bent), target, true).pose;
    EXPECT_NEAR(std::cbrt(pose.linear().determinant()), 1, 0.08);
    EXPECT_NEAR(fit(flat_join(bent), target, false).pose.linear().determinant(), 1, 1e-9);
}

TEST(Repair, LeavesASoundMeshAlone)
{
    const auto repaired = repair(sphere(10), {});
    ASSERT_TRUE(repaired);
    EXPECT_TRUE(repaired->repairs.empty());
    EXPECT_EQ(repaired->tree.mesh().triangles.size(), sphere(10).triangles.size());
}

TEST(Repair, TurnsAllTrianglesOutward)
{
    TriangleMesh mesh = sphere(10);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
    }
    const auto repaired = repair(mesh, {});
    ASSERT_TRUE(repaired);
    EXPECT_NEAR(signed_volume(repaired->tree.mesh()), signed_volume(sphere(10)), 1e-6);
}

TEST(Repair, ClosesAHole)
{
    TriangleMesh mesh = sphere(10);
    mesh.triangles.pop_back();
    const auto repaired = repair(mesh, {});
    ASSERT_TRUE(repaired);
    EXPECT_EQ(repaired->repairs.size(), 1U);
    EXPECT_NEAR(signed_volume(repaired->tree.mesh()), signed_volume(sphere(10)), 1);
}

TEST(Repair, WrapsTwoCrossingBallsAsOneSolid)
{
    TriangleMesh mesh = sphere(10);
    TriangleMesh other = sphere(10);
    transform(other, 1, Vec3(8, 1, 0));
    for (Triangle t : other.triangles) {
        for (int& v : t) {
            v += static_cast<int>(mesh.points.size());
        }
        mesh.triangles.push_back(t);
    }
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    const auto repaired = repair(mesh, {});
    ASSERT_TRUE(repaired);
    const double ball = signed_volume(sphere(10));
    EXPECT_GT(signed_volume(repaired->tree.mesh()), 1.3 * ball);
    EXPECT_LT(signed_volume(repaired->tree.mesh()), 1.8 * ball);
}

TEST(ImportMesh, MakesABallThatCanBeBuilt)
{
    const ImportedMesh& made = same_ball();
    EXPECT_NEAR(made.report.elements, 120, 6);
    EXPECT_LT(made.report.distance.rms(), 0.25 * made.report.la);
    EXPECT_LT(made.report.embedding.max_stretch, 0.01);
    EXPECT_TRUE(made.report.embedding.converged);
}

TEST(ImportMesh, HeightAndElementsSettleTheSizeOfTheElement)
{
    ImportOptions options;
    options.size.elements = 120;
    options.size.height = 300;
    const auto made = import_mesh(sphere(50), options);
    ASSERT_TRUE(made);
    EXPECT_NEAR(made->element.lb / made->element.la, 1.1, 1e-9);
    EXPECT_NEAR(made->report.scale * bounds(sphere(50)).sizes().z(), 300, 1e-6);
}

TEST(ImportMesh, TheDesignFileReplaysToTheSameSurface)
{
    const ImportedMesh& made = same_ball();
    Design design;
    design.element = made.element;
    design.operations = {made.operation, Flip{"body", Reference{}, false}};
    const auto read = parse_design(write_design(design));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(write_design(*read), write_design(design));
    const auto replayed = replay(*read);
    ASSERT_TRUE(replayed) << replayed.error().message;
    const Surface& surface = replayed->stages.front().surface;
    for (const Vertex v : surface.vertices()) {
        EXPECT_LT((surface.point(v) - made.operation.positions[v.idx()]).norm(), 0.1);
    }
}

TEST(ImportMesh, IsTheSameEveryTime)
{
    EXPECT_EQ(write_design({"", {}, {}, {imported_ball().operation}}),
              write_design({"", {}, {}, {same_ball().operation}}));
}

TEST(ImportMesh, OpenFlipMergeAndExtrudeFollow)
{
    const ImportedMesh& made = same_ball();
    const double top = bounds(made.target).max().z();
    const auto toward = [](double x, double y, double z) { return Reference{Reference::Kind::Toward, 0, {x, y, z}}; };
    Design design;
    design.element = made.element;
    design.operations = {made.operation,
                         Place{"head", "ball-30", {0, 0, top + 60}},
                         Merge{"body", "head"},
                         Extrude{"", "body", toward(1, 0, 0), "ball-30", {250, 0, 0}},
                         Open{"body", {toward(-1, 0, -1)}, "lamp holder"},
                         Flip{"body", toward(-1, 0, 1)}};
    const auto replayed = replay(design);
    ASSERT_TRUE(replayed) << replayed.error().message;
    EXPECT_GT(replayed->surface.n_faces(), made.operation.quads.size() + 20);
    EXPECT_TRUE(validate(replayed->surface, made.element).ok());
    EXPECT_TRUE(replayed->embedding.converged);
}

TEST(ImportMesh, KeepsTheDistanceInTheDesignFile)
{
    const ImportedMesh& made = same_ball();
    const auto read = parse_design(write_design({"", made.element, {}, {made.operation}}));
    ASSERT_TRUE(read) << read.error().message;
    const auto& distance = std::get<Import>(read->operations.front()).distance;
    ASSERT_TRUE(distance);
    EXPECT_NEAR(distance->to_target_rms, made.report.distance.to_target.rms, 1e-3);
    EXPECT_NEAR(distance->from_target_max, made.report.distance.from_target.max, 1e-3);
}

TEST(ImportMesh, WarnsWhenTheElementsEndFarFromTheTarget)
{
    const ImportedMesh& made = same_ball();
    EXPECT_TRUE(made.report.warnings.empty());
    Import far = made.operation;
    far.distance->from_target_rms = 0.71 * made.element.la;
    const std::string warning = distance_warning(far, made.element);
    EXPECT_NE(warning.find("0.71 la"), std::string::npos) << warning;
    EXPECT_NE(warning.find("--elements " + std::to_string(4 * far.quads.size())), std::string::npos) << warning;
    far.distance.reset();
    EXPECT_TRUE(distance_warning(far, made.element).empty());
}

TEST(ImportMesh, AThinPlateIsMadeThickEnoughAndThatIsTold)
{
    ImportOptions options;
    options.size.elements = 150;
    const auto made = import_mesh(box({100, 80, 2}), options);
    ASSERT_TRUE(made) << made.error().message;
    ASSERT_FALSE(made->report.repairs.empty());
    EXPECT_NE(made->report.repairs.back().find("of the target is thinner than"), std::string::npos)
        << made->report.repairs.back();
    EXPECT_LT(made->report.distance.rms(), made->element.la);
    EXPECT_NEAR(bounds(made->target).sizes().z() / bounds(made->target).sizes().x(), 0.02, 0.005); // as it was given
}

TEST(Decimate, KeepsTheTopologyAndPointsOfTheMesh)
{
    const TriangleMesh mesh = sphere(100);
    const TriangleMesh fewer = decimate(mesh, 60);
    EXPECT_LT(fewer.triangles.size(), mesh.triangles.size() / 2);
    EXPECT_EQ(2 * fewer.points.size(), fewer.triangles.size() + 4);
    const MeshTree tree(mesh);
    for (const Vec3& p : fewer.points) {
        EXPECT_LT(tree.nearest(p).distance, 1e-9);
    }
}

} // namespace rhombloom
