#pragma once

#include "core/design/mesh_import/triangle_mesh.h"
#include "core/model/triangulation.h"

namespace rhombloom {

inline TriangleMesh sphere(double radius)
{
    const Triangulation unit = geodesic(Deltahedron::Icosahedron, 4, 0);
    TriangleMesh mesh{unit.points, unit.triangles};
    transform(mesh, radius, Vec3::Zero());
    return mesh;
}

//! A ball of radius 100 with a limb of radius 18 up to z = 400: a profile turned about z.
inline TriangleMesh ball_with_limb()
{
    std::vector<std::pair<double, double>> profile; // radius, z
    for (int k = 1; k <= 20; ++k) {
        const double a = pi * (1 - k / 21.0);
        profile.emplace_back(100 * std::sin(a), 100 * std::cos(a));
    }
    std::erase_if(profile, [](const auto& p) { return p.first < 18 && p.second > 0; });
    for (double z = profile.back().second + 10; z < 395; z += 10) {
        profile.emplace_back(18, z);
    }
    constexpr int around = 24;
    TriangleMesh mesh;
    for (const auto& [radius, z] : profile) {
        for (int k = 0; k < around; ++k) {
            mesh.points.emplace_back(radius * std::cos(two_pi * k / around), radius * std::sin(two_pi * k / around), z);
        }
    }
    const int rings = static_cast<int>(profile.size());
    const int bottom = rings * around;
    mesh.points.emplace_back(0, 0, -100);
    mesh.points.emplace_back(0, 0, 400);
    for (int k = 0; k < around; ++k) {
        const int n = (k + 1) % around;
        mesh.triangles.push_back({bottom, n, k});
        mesh.triangles.push_back({bottom + 1, (rings - 1) * around + k, (rings - 1) * around + n});
        for (int r = 0; r + 1 < rings; ++r) {
            mesh.triangles.push_back({r * around + k, r * around + n, (r + 1) * around + n});
            mesh.triangles.push_back({r * around + k, (r + 1) * around + n, (r + 1) * around + k});
        }
    }
    return mesh;
}

inline TriangleMesh box(const Vec3& sizes)
{
    TriangleMesh mesh;
    for (int k = 0; k < 8; ++k) {
        mesh.points.emplace_back(sizes.cwiseProduct(Vec3(k & 1, k >> 1 & 1, k >> 2 & 1)));
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

} // namespace rhombloom
