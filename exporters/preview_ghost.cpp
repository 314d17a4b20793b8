#include "exporters/preview_ghost.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <map>
#include <set>

#include "core/design/mesh_import/mesh_decimate.h"
#include "exporters/preview_pack.h"

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;

//! Does every edge have a triangle on either side, once?
bool is_closed(const TriangleMesh& mesh)
{
    std::set<std::pair<int, int>> edges;
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            if (t[k] == t[(k + 1) % 3] || !edges.emplace(t[k], t[(k + 1) % 3]).second) {
                return false;
            }
        }
    }
    return std::all_of(edges.begin(), edges.end(), [&](const auto& e) { return edges.count({e.second, e.first}) > 0; });
}

//! Triangles so that each shares a side with one before it where possible, each turned so that new points come last.
std::vector<Triangle> in_walking_order(const std::vector<Triangle>& triangles)
{
    std::map<std::pair<int, int>, int> left_of;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            left_of[{triangles[i][k], triangles[i][(k + 1) % 3]}] = static_cast<int>(i);
        }
    }
    std::vector<Triangle> result;
    std::vector<bool> seen(triangles.size(), false);
    for (std::size_t first = 0; first < triangles.size(); ++first) {
        std::deque<Triangle> open;
        if (!seen[first]) {
            seen[first] = true;
            open.push_back(triangles[first]);
        }
        for (; !open.empty(); open.pop_front()) {
            const Triangle t = open.front();
            result.push_back(t);
            for (int k = 0; k < 3; ++k) {
                const auto next = left_of.find({t[(k + 1) % 3], t[k]});
                if (next != left_of.end() && !seen[next->second]) {
                    seen[next->second] = true;
                    Triangle turned = triangles[next->second];
                    while (turned[0] != t[(k + 1) % 3]) {
                        std::rotate(turned.begin(), turned.begin() + 1, turned.end());
                    }
                    open.push_back(turned);
                }
            }
        }
    }
    return result;
}

//! The same mesh, its points in the order in which the triangles come to them.
TriangleMesh walked(const TriangleMesh& mesh)
{
    TriangleMesh result;
    std::vector<int> number(mesh.points.size(), -1);
    for (Triangle t : in_walking_order(mesh.triangles)) {
        for (int& v : t) {
            if (number[v] < 0) {
                number[v] = static_cast<int>(result.points.size());
                result.points.push_back(mesh.points[v]);
            }
            v = number[v];
        }
        result.triangles.push_back(t);
    }
    return result;
}

template <class T>
void append_raw(std::string& bytes, T value)
{
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    bytes.append(raw.data(), raw.size());
}

int add_ghost_material(Glb& glb)
{
    glb.json["materials"].push_back(
        {{"name", "target"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.45, 0.5, 0.58, 0.35}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
         {"alphaMode", "BLEND"}});
    return static_cast<int>(glb.json["materials"].size()) - 1;
}

//! In a scene of its own: who opens the file sees the lamp alone.
void add_ghost_scene(Glb& glb, Json primitive)
{
    glb.json["scenes"].push_back({{"name", "target"}, {"nodes", {glb.json["nodes"].size()}}});
    glb.json["nodes"].push_back({{"name", "target"}, {"mesh", glb.json["meshes"].size()}});
    glb.json["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
}

} // namespace

TriangleMesh ghost_of(const TriangleMesh& target, std::size_t most_points)
{
    TriangleMesh result = target;
    if (result.points.size() > most_points && !is_closed(result)) {
        return {};
    }
    while (result.points.size() > most_points) {
        const double share = static_cast<double>(result.points.size()) / static_cast<double>(most_points);
        double sum = 0;
        for (const Triangle& t : result.triangles) {
            sum += (result.points[t[0]] - result.points[t[1]]).norm();
        }
        const double edge = sum / static_cast<double>(result.triangles.size());
        TriangleMesh fewer = decimate(result, std::max(1.1, std::sqrt(share)) * edge);
        if (fewer.points.size() >= result.points.size()) {
            return {};
        }
        result = std::move(fewer);
    }
    return walked(result);
}

std::string packed_ghost(const TriangleMesh& ghost)
{
    constexpr double steps = 4000;
    const Eigen::AlignedBox3d box = bounds(ghost);
    const double step = std::max(box.sizes().maxCoeff() / steps, 1e-6);
    std::string bytes;
    append_raw(bytes, static_cast<std::uint32_t>(ghost.points.size()));
    append_raw(bytes, static_cast<std::uint32_t>(ghost.triangles.size()));
    for (const double value : {box.min().x(), box.min().y(), box.min().z(), step}) {
        append_raw(bytes, static_cast<float>(value));
    }
    for (int r = 0; r < 3; ++r) {
        std::vector<int> differences;
        int before = 0;
        for (const Vec3& p : ghost.points) {
            const int now = static_cast<int>(std::lround((p[r] - box.min()[r]) / step));
            differences.push_back(now - before);
            before = now;
        }
        append_sorted_bytes(bytes, differences, 2);
    }
    std::vector<int> behind;
    int next = 0;
    for (const Triangle& t : ghost.triangles) {
        for (const int v : t) {
            behind.push_back(next - v);
            next = std::max(next, v + 1);
        }
    }
    append_sorted_bytes(bytes, behind, 2);
    return packed_text(bytes);
}

void add_plain_ghost(Glb& glb, const TriangleMesh& ghost)
{
    std::vector<Eigen::Vector3f> points;
    for (const Vec3& p : ghost.points) {
        points.push_back(to_gltf(p));
    }
    const int material = add_ghost_material(glb);
    add_ghost_scene(glb, {{"attributes", {{"POSITION", add_points(glb, points)}}},
                          {"indices", add_indices(glb, ghost.triangles)},
                          {"material", material}});
}

} // namespace rhombloom
