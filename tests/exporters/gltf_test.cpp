#include "exporters/gltf.h"

#include <gtest/gtest.h>

#include "exporters/draco_mesh.h"

namespace rhombloom {
namespace {

DracoMesh grid(int n)
{
    DracoMesh mesh;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            mesh.points.emplace_back(0.01F * static_cast<float>(i), 0.01F * static_cast<float>(j),
                                     0.003F * static_cast<float>((i * j) % 7));
            mesh.normals.emplace_back(0.F, 0.F, 1.F);
            mesh.order.push_back(static_cast<std::uint16_t>(i * n + j));
            if (i + 1 < n && j + 1 < n) {
                mesh.triangles.push_back({i * n + j, (i + 1) * n + j, i * n + j + 1});
            }
        }
    }
    return mesh;
}

TEST(Draco, KeepsTheTolerance)
{
    const DracoMesh mesh = grid(30);
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
        const PointGrid lattice = point_grid(mesh.points, tolerance);
        const DracoMesh decoded = *decompress(*compress(mesh, lattice, 8));
        const std::vector<Eigen::Vector3f> foreseen = on_grid(mesh.points, lattice);
        ASSERT_FALSE(decoded.points.empty());
        for (std::size_t i = 0; i < decoded.points.size(); ++i) {
            EXPECT_LE((decoded.points[i] - mesh.points[decoded.order[i]]).norm(), tolerance);
            EXPECT_LE((decoded.points[i] - foreseen[decoded.order[i]]).norm(), 1e-3 * lattice.step);
        }
    }
}

TEST(Draco, StepsUseTheWholeTolerance)
{
    const DracoMesh mesh = grid(30);
    const PointGrid lattice = point_grid(mesh.points, 5e-5);
    EXPECT_GT(lattice.step * std::sqrt(3.0) / 2, 0.97 * 5e-5);
    EXPECT_LT(std::exp2(lattice.bits - 1) * lattice.step, 0.3); // one bit fewer would not reach across
}

// A wavy sheet: expected normals are close to the smooth ones and take next to no bytes.
TEST(Draco, ExpectedNormalsAreFree)
{
    DracoMesh mesh;
    constexpr int n = 40;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const float x = 0.01F * static_cast<float>(i);
            const float y = 0.01F * static_cast<float>(j);
            mesh.points.emplace_back(x, y, 0.02F * std::sin(20 * x) * std::cos(15 * y));
            mesh.normals.push_back(Eigen::Vector3f(-0.4F * std::cos(20 * x) * std::cos(15 * y),
                                                   0.3F * std::sin(20 * x) * std::sin(15 * y), 1)
                                       .normalized());
            if (i + 1 < n && j + 1 < n) {
                const int v = i * n + j;
                mesh.triangles.push_back({v, v + n, v + 1});
                mesh.triangles.push_back({v + n, v + n + 1, v + 1});
            }
        }
    }
    const PointGrid lattice = point_grid(mesh.points, 1e-5);
    const std::size_t smooth = compress(mesh, lattice, 8)->bytes.size();
    const std::vector<Eigen::Vector3f> normals = expected_normals(mesh, lattice, 8, 20);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        EXPECT_GT(normals[i].dot(mesh.normals[i]), 0.95F) << i;
    }
    mesh.normals = normals;
    const std::size_t free = compress(mesh, lattice, 8)->bytes.size();
    mesh.normals.clear();
    const std::size_t without = compress(mesh, lattice, 8)->bytes.size();
    EXPECT_LT(free, without + 100);
    EXPECT_GT(smooth, without + 400);
}

TEST(Gltf, FileHasItsLengthAndItsChunks)
{
    Glb glb = make_glb("t");
    add_points(glb, {{1, 2, 3}, {4, 5, 6}});
    const std::string bytes = glb_bytes(glb);
    const auto word = [&](std::size_t at) {
        return static_cast<unsigned char>(bytes[at]) | static_cast<unsigned char>(bytes[at + 1]) << 8 |
               static_cast<unsigned char>(bytes[at + 2]) << 16 | static_cast<unsigned char>(bytes[at + 3]) << 24;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(8), static_cast<int>(bytes.size()));
    const int json = word(12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(json % 4, 0);
    EXPECT_EQ(word(20 + json), 24);
    EXPECT_EQ(bytes.substr(24 + json, 4), std::string("BIN\0", 4));
    EXPECT_EQ(static_cast<int>(bytes.size()), 28 + json + 24);
}

TEST(Gltf, FloatsAreShort)
{
    EXPECT_EQ(nlohmann::json(short_float(0.1F)).dump(), "0.1");
    EXPECT_EQ(static_cast<float>(short_float(0.04027525F)), 0.04027525F);
    EXPECT_EQ(short_float(-0.F), 0);
}

TEST(Gltf, MillimetresZUpBecomeMetresYUp)
{
    EXPECT_LT((to_gltf(Vec3(1000, 2000, 3000)) - Eigen::Vector3f(1, 3, -2)).norm(), 1e-6);
}

} // namespace
} // namespace rhombloom
