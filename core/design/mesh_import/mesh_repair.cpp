#include "core/design/mesh_import/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/design/mesh_import/mesh_distance.h"
#include "core/design/mesh_import/mesh_shells.h"
#include "core/design/mesh_import/mesh_weld.h"
#include "core/design/mesh_import/mesh_wrap.h"
#include "core/text.h"

namespace rhombloom {

namespace {

constexpr double farthest = 1e12;        // beyond, products of coordinates lose all meaning
constexpr double stray_share = 0.1;      // of the area: smaller shells beside the largest are dropped
constexpr double opening_share = 0.4;    // of the area: larger openings make it an open sheet
constexpr double cells_per_edge = 5;     // of the wrapping grid, per side of a final triangle
constexpr double most_cells = 4'000'000; // of the wrapping grid

//! A mesh on its way, and what was done to it.
struct Repair
{
    TriangleMesh mesh;
    std::vector<std::string> repairs;
};

std::string counted(std::size_t count, const std::string& thing)
{
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

bool usable(const Vec3& p)
{
    return p.allFinite() && p.cwiseAbs().maxCoeff() <= farthest;
}

Expected<void> drop_unusable(Repair& result)
{
    std::vector<Triangle>& triangles = result.mesh.triangles;
    const std::size_t before = triangles.size();
    std::erase_if(triangles, [&](const Triangle& t) {
        return !std::all_of(t.begin(), t.end(), [&](int v) { return usable(result.mesh.points[v]); });
    });
    const std::size_t dropped = before - triangles.size();
    if (2 * dropped >= before) {
        return refuse(std::to_string(dropped) + " of " + counted(before, "triangle") +
                      " have corners that are not finite or beyond 1e12: the file is damaged");
    }
    if (dropped > 0) {
        result.repairs.push_back(counted(dropped, "triangle") + " with corners that are not finite left out");
    }
    drop_unused_points(result.mesh);
    return {};
}

void drop_degenerate(Repair& result)
{
    std::vector<Triangle>& triangles = result.mesh.triangles;
    const std::size_t before = triangles.size();
    std::erase_if(triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    std::vector<std::pair<Triangle, int>> sorted;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        Triangle t = triangles[i];
        std::sort(t.begin(), t.end());
        sorted.emplace_back(t, static_cast<int>(i));
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<bool> again(triangles.size(), false);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        again[sorted[i].second] = sorted[i].first == sorted[i - 1].first;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (!again[i]) {
            triangles[kept++] = triangles[i];
        }
    }
    triangles.resize(kept);
    if (kept < before) {
        result.repairs.push_back(counted(before - kept, "degenerate or duplicate triangle") + " left out");
    }
    drop_unused_points(result.mesh);
}

double ring_length(const TriangleMesh& mesh, const std::vector<int>& ring)
{
    double sum = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        sum += (mesh.points[ring[k]] - mesh.points[ring[(k + 1) % ring.size()]]).norm();
    }
    return sum;
}

//! A fan over the ring from its middle.
void close_ring(TriangleMesh& mesh, const std::vector<int>& ring)
{
    const int middle = static_cast<int>(mesh.points.size());
    Vec3 sum = Vec3::Zero();
    for (const int v : ring) {
        sum += mesh.points[v];
    }
    mesh.points.emplace_back(sum / static_cast<double>(ring.size()));
    for (std::size_t k = 0; k < ring.size(); ++k) {
        mesh.triangles.push_back({ring[(k + 1) % ring.size()], ring[k], middle});
    }
}

Expected<void> close_holes(Repair& result)
{
    const std::vector<std::vector<int>> rings = boundary_rings(result.mesh);
    if (rings.empty()) {
        return {};
    }
    const double before = area(result.mesh);
    double longest = 0;
    for (const std::vector<int>& ring : rings) {
        longest = std::max(longest, ring_length(result.mesh, ring));
        close_ring(result.mesh, ring);
    }
    const double share = 1 - before / area(result.mesh);
    if (share > opening_share) {
        return refuse("the mesh is an open sheet: closing its " + counted(rings.size(), "opening") + " would add " +
                      to_fixed(100 * share, 0) + " % of surface; give it a thickness or close it");
    }
    result.repairs.push_back(counted(rings.size(), "hole") + " closed, together " + to_fixed(100 * share, 1) +
                             " % of the surface, the longest rim " +
                             to_fixed(100 * longest / bounds(result.mesh).diagonal().norm(), 1) + " % of the diagonal");
    return {};
}

//! The share of points just inside the surface that are not inside of it once.
double crossing_share(const MeshTree& tree)
{
    constexpr int probes = 1500;
    const double depth = 1e-4 * bounds(tree.mesh()).diagonal().norm();
    int bad = 0;
    const std::vector<Vec3> points = sample(tree.mesh(), probes);
    for (const Vec3& p : points) {
        const Vec3 normal = tree.normal(tree.nearest(p).triangle);
        const double inside = tree.winding_number(p - depth * normal);
        const double outside = tree.winding_number(p + depth * normal);
        bad += std::abs(inside - 1) > 0.3 && std::abs(outside) > 0.3 ? 1 : 0;
    }
    return static_cast<double>(bad) / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

//! Keep the largest shell by area; refuse when what would be lost is too much.
Expected<void> keep_largest_shell(Repair& result, bool cavities_are_gone)
{
    const Shells shells = orient_shells(result.mesh);
    std::vector<double> areas(shells.count, 0);
    for (std::size_t i = 0; i < result.mesh.triangles.size(); ++i) {
        areas[shells.shell[i]] += area_normal(result.mesh, result.mesh.triangles[i]).norm() / 2;
    }
    if (shells.count <= 1) {
        return {};
    }
    const auto largest = std::max_element(areas.begin(), areas.end()) - areas.begin();
    const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
    if (cavities_are_gone && total - areas[largest] > stray_share * total) {
        return refuse("the mesh falls into " + std::to_string(shells.count) + " separate solids, the largest with " +
                      to_fixed(100 * areas[largest] / total, 0) +
                      " % of the surface: join them or make them separate designs");
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < result.mesh.triangles.size(); ++i) {
        if (shells.shell[i] == largest) {
            result.mesh.triangles[kept++] = result.mesh.triangles[i];
        }
    }
    result.mesh.triangles.resize(kept);
    drop_unused_points(result.mesh);
    result.repairs.push_back(counted(shells.count - 1, "small separate part") + " left out, " +
                             to_fixed(100 * (1 - areas[largest] / total), 1) + " % of the surface");
    return {};
}

//! Voids inside of a solid cannot be seen and not be built.
void drop_cavities(Repair& result)
{
    const TriangleMesh copy = result.mesh;
    const Shells shells = orient_shells(result.mesh); // turns all outward: a shell that was turned is a void
    std::vector<bool> turned(shells.count, false);
    for (std::size_t i = 0; i < copy.triangles.size(); ++i) {
        turned[shells.shell[i]] = copy.triangles[i] != result.mesh.triangles[i];
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < copy.triangles.size(); ++i) {
        if (!turned[shells.shell[i]]) {
            result.mesh.triangles[kept++] = result.mesh.triangles[i];
        }
    }
    result.mesh.triangles.resize(kept);
    drop_unused_points(result.mesh);
    const auto voids = std::count(turned.begin(), turned.end(), true);
    if (voids > 0) {
        result.repairs.push_back(counted(voids, "void") + " inside left out");
    }
}

Expected<void> wrap_anew(Repair& result, int elements, const std::string& why)
{
    const double edge = std::sqrt(area(result.mesh) / elements * 2 * std::sqrt(3.0));
    WrapOptions options;
    const Vec3 sizes = bounds(result.mesh).sizes();
    options.cell = std::max({edge / cells_per_edge, std::cbrt(sizes.prod() / most_cells), sizes.maxCoeff() / 400});
    if (!(options.cell > 0)) {
        return refuse("the mesh has no extent: all its triangles are degenerate");
    }
    TriangleMesh wrapped = wrap(MeshTree(result.mesh), options);
    if (wrapped.triangles.empty()) {
        return refuse("the mesh encloses nothing that could be built (" + why + "): give it a volume");
    }
    result.mesh = std::move(wrapped);
    result.repairs.push_back("wrapped anew on a grid of " + to_text(std::round(1000 * options.cell) / 1000) +
                             " units: " + why);
    drop_cavities(result);
    if (auto ok = keep_largest_shell(result, true); !ok) {
        return ok;
    }
    split_fans(result.mesh);
    return {};
}

//! Why the mesh has to be wrapped, as far as its connectivity tells; empty when it can stay as it is.
std::string reason_to_wrap(const Shells& shells)
{
    if (shells.crowded_edges > 0) {
        return counted(shells.crowded_edges, "edge") + " with more than two triangles";
    }
    return shells.count > 1 ? std::to_string(shells.count) + " shells" : "";
}

//! The same, as far as its position in space tells.
std::string reason_to_wrap(const MeshTree& tree)
{
    constexpr double tolerable = 0.002;
    const double share = crossing_share(tree);
    return share > tolerable ? "the surface crosses itself over " + to_fixed(100 * share, 1) + " % of its area" : "";
}

Expected<void> check_two_sided(const Shells& shells)
{
    const auto one_sided = std::count(shells.one_sided.begin(), shells.one_sided.end(), true);
    if (one_sided == 0) {
        return {};
    }
    return refuse(
        "the surface is one-sided, like a Moebius strip: elements have an inside and an outside, so it cannot "
        "be built");
}

} // namespace

Expected<RepairedMesh> repair(const TriangleMesh& mesh, const RepairOptions& options)
{
    const auto tell = [&](const std::string& what) { return !options.progress || options.progress(what); };
    Repair result{mesh, {}};
    if (auto ok = drop_unusable(result); !ok) {
        return tl::make_unexpected(ok.error());
    }
    weld(result.mesh);
    drop_degenerate(result);
    if (!tell("repairing the mesh") || result.mesh.triangles.empty() || !(area(result.mesh) > 0)) {
        return refuse("the mesh has no triangle with an area");
    }
    const Shells shells = orient_shells(result.mesh);
    if (auto ok = check_two_sided(shells); !ok) {
        return tl::make_unexpected(ok.error());
    }
    if (shells.crowded_edges == 0) {
        split_fans(result.mesh);
        if (auto ok = close_holes(result); !ok) {
            return tl::make_unexpected(ok.error());
        }
    }
    std::string why = reason_to_wrap(shells);
    if (why.empty()) {
        MeshTree tree(std::move(result.mesh));
        why = reason_to_wrap(tree);
        if (why.empty()) {
            return RepairedMesh{std::move(tree), std::move(result.repairs)};
        }
        result.mesh = tree.mesh();
    }
    tell("wrapping the mesh");
    if (auto ok = wrap_anew(result, options.elements, why); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return RepairedMesh{MeshTree(std::move(result.mesh)), std::move(result.repairs)};
}

} // namespace rhombloom
