#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "core/design/mesh_import/mesh_decimate.h"
#include "core/design/mesh_import/mesh_tree.h"
#include "core/design/mesh_import/mesh_weld.h"
#include "core/units.h"

namespace rhombloom {

namespace {

constexpr int around = 500;
constexpr int across = 250;
constexpr double radius = 100;
constexpr double tube = 40;

//! A torus of a quarter of a million triangles about the z axis.
TriangleMesh torus()
{
    TriangleMesh mesh;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = two_pi * i / around;
            const double v = two_pi * j / across;
            const double r = radius + tube * std::cos(v);
            mesh.points.emplace_back(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
            const auto at = [&](int k, int l) { return (i + k) % around * across + (j + l) % across; };
            mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
            mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    return mesh;
}

//! Every triangle with corners of its own, in no order, as a file has them.
TriangleMesh soup(const TriangleMesh& mesh)
{
    std::vector<int> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    TriangleMesh result;
    for (const int k : order) {
        const int first = static_cast<int>(result.points.size());
        for (const int v : mesh.triangles[k]) {
            result.points.push_back(mesh.points[v]);
        }
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

TriangleMesh welded_torus()
{
    TriangleMesh mesh = soup(torus());
    weld(mesh);
    return mesh;
}

double distance_from_torus(const Vec3& p)
{
    return std::hypot(std::hypot(p.x(), p.y()) - radius, p.z()) - tube;
}

//! How often each directed edge is used.
std::map<std::pair<int, int>, int> edge_uses(const TriangleMesh& mesh)
{
    std::map<std::pair<int, int>, int> uses;
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            ++uses[{t[k], t[(k + 1) % 3]}];
        }
    }
    return uses;
}

} // namespace

TEST(Weld, KeepsTheFirstOfEqualPointsAndTheOrderOfASmallMesh)
{
    TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 1e-9}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}};
    weld(mesh);
    ASSERT_EQ(mesh.points.size(), 4U);
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
    EXPECT_EQ(mesh.points[3], Vec3(1, 1, 0));
}

TEST(Weld, NumbersALargeMeshSoThatNeighboursAreNearInMemory)
{
    const TriangleMesh mesh = welded_torus();
    EXPECT_EQ(mesh.points.size(), static_cast<std::size_t>(around * across));
    EXPECT_EQ(mesh.triangles.size(), 2 * mesh.points.size());
    EXPECT_NEAR(signed_volume(mesh), signed_volume(torus()), 1e-6 * signed_volume(mesh));
    double apart = 0;
    for (const Triangle& t : mesh.triangles) {
        apart += *std::max_element(t.begin(), t.end()) - *std::min_element(t.begin(), t.end());
    }
    // Without an order a third of all points lie between two.
    EXPECT_LT(apart / static_cast<double>(mesh.triangles.size()), 0.02 * static_cast<double>(mesh.points.size()));
}

TEST(Decimate, ALargeMeshIsClosedAndEvenAlsoWhereItsPartsMeet)
{
    constexpr double edge = 5;
    const TriangleMesh fewer = decimate(welded_torus(), edge);
    EXPECT_LT(fewer.triangles.size(), 12'500U);                 // of 250,000
    EXPECT_EQ(2 * fewer.points.size(), fewer.triangles.size()); // genus 1
    int shorter = 0;
    const auto uses = edge_uses(fewer);
    for (const auto& [ends, count] : uses) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(uses.count({ends.second, ends.first}), 1U);
        shorter += (fewer.points[ends.first] - fewer.points[ends.second]).norm() < 0.6 * edge ? 1 : 0;
    }
    EXPECT_LT(shorter, 0.02 * static_cast<double>(uses.size()));
    for (const Triangle& t : fewer.triangles) {
        const Vec3 middle = (fewer.points[t[0]] + fewer.points[t[1]] + fewer.points[t[2]]) / 3;
        EXPECT_NEAR(distance_from_torus(middle), 0, 0.02 * tube);
    }
}

TEST(MeshTree, OfManyTrianglesFindsTheNearestAndTheInside)
{
    MeshTree tree(welded_torus());
    constexpr double fine = 0.02;   // chords are that far off the torus
    constexpr double coarse = 0.05; // of a winding number
    const std::vector<Vec3> points = {{150, 20, 5}, {-90, 60, 10}, {0, 0, 3}, {60, -130, -45}, {95, 0, 0}};
    for (const Vec3& p : points) {
        EXPECT_NEAR(tree.nearest(p).distance, std::abs(distance_from_torus(p)), fine);
        EXPECT_NEAR(tree.winding_number(p), distance_from_torus(p) < 0 ? 1 : 0, coarse);
    }
    const Vec3 shift(7, -3, 11);
    tree.transform(0.5, shift);
    for (const Vec3& p : points) {
        const NearestPoint near = tree.nearest(0.5 * p + shift);
        EXPECT_NEAR(near.distance, 0.5 * std::abs(distance_from_torus(p)), fine);
        EXPECT_NEAR(distance_from_torus((near.point - shift) / 0.5), 0, fine);
        EXPECT_NEAR(tree.winding_number(0.5 * p + shift), distance_from_torus(p) < 0 ? 1 : 0, coarse);
    }
}

} // namespace rhombloom
