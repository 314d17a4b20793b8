#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/design/mesh_import/curvature_match.h"
#include "core/design/mesh_import/metric_misfit.h"
#include "core/model/triangulation.h"

namespace rhombloom {

namespace {

TriangleMesh ball(int frequency)
{
    const Triangulation unit = geodesic(Deltahedron::Icosahedron, frequency, 0);
    return {unit.points, unit.triangles};
}

//! Any curvature that is zero in sum.
Eigen::VectorXd some_residual(int n)
{
    Eigen::VectorXd result(n);
    for (int i = 0; i < n; ++i) {
        result[i] = std::sin(7.0 * i);
    }
    result.array() -= result.mean();
    return result;
}

double mean_edge(const TriangleMesh& mesh)
{
    return mean_edge_length(edit_mesh(mesh));
}

//! Pairs of neighbours of degree 7 or more.
int crowded_pairs(const TriangleMesh& triangles)
{
    const EditMesh mesh = edit_mesh(triangles);
    int result = 0;
    for (const auto e : mesh.edges()) {
        const auto h = mesh.halfedge_handle(e, 0);
        result += mesh.valence(mesh.from_vertex_handle(h)) > 6 && mesh.valence(mesh.to_vertex_handle(h)) > 6;
    }
    return result;
}

} // namespace

TEST(MetricMisfit, IsThatOfTheDenseInverse)
{
    const EditMesh mesh = edit_mesh(ball(3));
    const int n = static_cast<int>(mesh.n_vertices());
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
    for (const auto h : mesh.halfedges()) {
        const int a = mesh.from_vertex_handle(h).idx();
        L(a, a) += 1 / std::sqrt(3.0);
        L(a, mesh.to_vertex_handle(h).idx()) -= 1 / std::sqrt(3.0);
    }
    const Eigen::VectorXd residual = some_residual(n);
    const Eigen::VectorXd u = L.completeOrthogonalDecomposition().solve(residual);
    const Eigen::VectorXd smooth = (Eigen::MatrixXd::Identity(n, n) + L).llt().solve(u);
    EXPECT_NEAR(MetricMisfit(mesh, residual).value(), smooth.squaredNorm(), 1e-5 * smooth.squaredNorm());
}

TEST(MetricMisfit, GrowsByWhatWasForetold)
{
    const EditMesh mesh = edit_mesh(ball(3));
    MetricMisfit misfit(mesh, some_residual(static_cast<int>(mesh.n_vertices())));
    const CurvatureChange change{{3, 40, 17, 60}, {-1, -1, 1, 1}};
    const double before = misfit.value();
    const Eigen::VectorXd response = misfit.response(change);
    const double foretold = misfit.first_order(change) + MetricMisfit::own_square(change, response);
    misfit.apply(change, response);
    EXPECT_GT(std::abs(foretold), 1e-3);
    EXPECT_NEAR(misfit.value() - before, foretold, 1e-9);
}

TEST(MatchCurvature, CrowdingHasAPriceThatKeepsVerticesOfDegreeSevenApart)
{
    const MeshTree target(ball(12));
    std::array<int, 2> pairs{};
    for (const int k : {0, 1}) {
        TriangleMesh triangles = ball(6);
        MatchOptions options;
        options.edge = mean_edge(triangles);
        options.temperature = 1e-2;
        options.rounds = 6;
        options.crowding = k == 0 ? 0 : 1e-2;
        match_curvature(triangles, target, options);
        EXPECT_EQ(triangles.triangles.size(), ball(6).triangles.size());
        pairs[k] = crowded_pairs(triangles);
    }
    EXPECT_GT(pairs[0], 5);
    EXPECT_LT(2 * pairs[1], pairs[0]);
}

} // namespace rhombloom
