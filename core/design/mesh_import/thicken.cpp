#include "core/design/mesh_import/thicken.h"

#include <algorithm>
#include <cmath>

#include "core/design/mesh_import/remesh.h"
#include "core/form/parallel.h"

namespace rhombloom {

namespace {

constexpr double faces_back = -0.7; // cosine between the normals of two walls: less than 45 degrees apart

//! How far it is from \p p along \p direction to a wall that faces the other way; at most \p most.
double room(const MeshTree& tree, const Vec3& p, const Vec3& normal, const Vec3& direction, double most)
{
    constexpr int steps = 10;
    for (int k = 1; k <= steps; ++k) {
        const NearestPoint near = tree.nearest(p + most * k / steps * direction);
        if (tree.normal(near.triangle).dot(normal) < faces_back) {
            return std::clamp((near.point - p).dot(direction), 0.0, most);
        }
    }
    return most;
}

//! Every value becomes the mean of itself and that of its neighbours, \p passes times.
template <class Value>
void smooth(const TriangleMesh& mesh, std::vector<Value>& values, const Value& zero, int passes)
{
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<Value> sum(values.size(), zero);
        std::vector<int> count(values.size(), 0);
        for (const Triangle& t : mesh.triangles) {
            for (int k = 0; k < 3; ++k) {
                sum[t[k]] += values[t[(k + 1) % 3]];
                ++count[t[k]];
            }
        }
        for (std::size_t v = 0; v < values.size(); ++v) {
            values[v] = count[v] > 0 ? Value((values[v] + sum[v] / count[v]) / 2) : values[v];
        }
    }
}

std::vector<Vec3> point_normals(const TriangleMesh& mesh)
{
    std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
    for (const Triangle& t : mesh.triangles) {
        const Vec3 normal = area_normal(mesh, t);
        for (const int v : t) {
            normals[v] += normal;
        }
    }
    smooth<Vec3>(mesh, normals, Vec3::Zero(), 2);
    for (Vec3& normal : normals) {
        normal.normalize();
    }
    return normals;
}

//! By how much each point has to move outward.
std::vector<double> missing(const MeshTree& tree, const std::vector<Vec3>& normals, double radius)
{
    constexpr double almost = 0.97;
    constexpr double share_of_gap = 0.4;
    const std::vector<Vec3>& points = tree.mesh().points;
    std::vector<double> result(points.size(), 0);
    parallel_tasks(default_threads(), static_cast<int>(points.size()), [&](int v) {
        const double half = room(tree, points[v], normals[v], -normals[v], 2 * radius) / 2;
        if (half < almost * radius) {
            const double gap = room(tree, points[v], normals[v], normals[v], 2 * radius);
            result[v] = std::min(radius - half, share_of_gap * gap);
        }
    });
    return result;
}

double share_above_zero(const TriangleMesh& mesh, const std::vector<double>& values)
{
    double above = 0;
    for (const Triangle& t : mesh.triangles) {
        const auto corners = std::count_if(t.begin(), t.end(), [&](int v) { return values[v] > 0; });
        above += area_normal(mesh, t).norm() / 2 * static_cast<double>(corners) / 3;
    }
    return above / area(mesh);
}

} // namespace

ThickenedMesh thicken(const TriangleMesh& even, const ThickenOptions& options)
{
    constexpr int steps = 4;
    constexpr int smoothing = 3;
    constexpr double little = 0.03; // sharp edges, and what can be left out
    ThickenedMesh result{even, 0};
    for (int left = steps; left > 0; --left) {
        const MeshTree before(result.mesh);
        const std::vector<Vec3> normals = point_normals(before.mesh());
        std::vector<double> move = missing(before, normals, options.radius);
        if (left == steps) {
            result.share = share_above_zero(result.mesh, move);
        }
        if (result.share < little) {
            return {even, 0};
        }
        smooth<double>(before.mesh(), move, 0, smoothing);
        for (std::size_t v = 0; v < move.size(); ++v) {
            result.mesh.points[v] += move[v] / left * normals[v];
        }
        result.mesh = evened(MeshTree(std::move(result.mesh)), options.edge);
    }
    return result;
}

} // namespace rhombloom
