#include "core/design/mesh_import/join_network.h"

#include <map>

namespace rhombloom {

std::vector<Vec3> triangle_middles(const TriangleMesh& triangles, const MeshTree& target)
{
    std::vector<Vec3> result;
    for (const Triangle& t : triangles.triangles) {
        const Vec3 sum = triangles.points[t[0]] + triangles.points[t[1]] + triangles.points[t[2]];
        result.push_back(target.nearest(sum / 3).point);
    }
    return result;
}

SurfaceLists join_network(const TriangleMesh& triangles, const std::vector<Vec3>& middles)
{
    expects(middles.size() == triangles.triangles.size(), "join_network: one middle per triangle");
    SurfaceLists result;
    result.positions = triangles.points;
    result.positions.insert(result.positions.end(), middles.begin(), middles.end());
    const int corners = static_cast<int>(triangles.points.size());
    std::map<std::pair<int, int>, int> left_of; // the triangle on the left of a directed edge
    for (std::size_t i = 0; i < triangles.triangles.size(); ++i) {
        const Triangle& t = triangles.triangles[i];
        for (int k = 0; k < 3; ++k) {
            left_of[{t[k], t[(k + 1) % 3]}] = static_cast<int>(i);
        }
    }
    for (const auto& [edge, left] : left_of) {
        const auto right = left_of.find({edge.second, edge.first});
        if (edge.first < edge.second && right != left_of.end()) {
            result.quads.push_back({edge.first, corners + right->second, edge.second, corners + left});
        }
    }
    result.sides.assign(result.positions.size(), Side::Short);
    std::fill(result.sides.begin(), result.sides.begin() + corners, Side::Long);
    result.facing.assign(result.quads.size(), Facing::Front);
    result.component.assign(result.quads.size(), 0);
    result.serial.assign(result.quads.size(), -1);
    return result;
}

} // namespace rhombloom
