#include "core/design/mesh_import/close_gaps.h"

#include <algorithm>
#include <cmath>

#include "core/design/mesh_import/mesh_shells.h"
#include "core/design/mesh_import/mesh_wrap.h"
#include "core/design/mesh_import/remesh.h"

namespace rhombloom {

namespace {

//! Share of the area of \p mesh that lies deeper than \p depth inside of \p solid, of which it is a part.
double share_inside(const TriangleMesh& mesh, const MeshTree& solid, double depth)
{
    double inside = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3;
        inside += solid.nearest(middle).distance > depth ? area_normal(mesh, t).norm() / 2 : 0;
    }
    return inside / area(mesh);
}

TriangleMesh largest_shell(TriangleMesh mesh)
{
    const Shells shells = orient_shells(mesh);
    std::vector<double> areas(shells.count, 0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        areas[shells.shell[i]] += area_normal(mesh, mesh.triangles[i]).norm();
    }
    const auto largest = std::max_element(areas.begin(), areas.end()) - areas.begin();
    TriangleMesh result{std::move(mesh.points), {}};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (shells.shell[i] == largest) {
            result.triangles.push_back(mesh.triangles[i]);
        }
    }
    drop_unused_points(result);
    return result;
}

//! Of a closed surface.
int genus(const TriangleMesh& mesh)
{
    return 1 - (static_cast<int>(mesh.points.size()) - static_cast<int>(mesh.triangles.size()) / 2) / 2;
}

} // namespace

GapsClosed close_gaps(const TriangleMesh& even, const GapOptions& options)
{
    constexpr double deep = 0.3;    // of the width: a groove of a right angle is filled to a fifth of it
    constexpr double little = 0.01; // of the area
    constexpr double least_share = 1e-6;
    constexpr double most_cells = 20e6; // of the grid: 0.5 GB
    const Vec3 sizes = bounds(even).sizes() + Vec3::Constant(options.width);
    if (sizes.prod() > most_cells * std::pow(options.edge, 3)) {
        return {even, 0}; // a wire in a large space, or very many elements
    }
    const MeshTree before(even);
    MeshTree closed(largest_shell(wrap(before, {options.edge, options.width / 2})));
    const int handles = closed.mesh().triangles.empty() ? genus(even) + 1 : genus(closed.mesh());
    if (handles > genus(even)) {
        return {even, 0};
    }
    const double share = share_inside(even, closed, deep * options.width);
    if (share < little && handles == genus(even)) {
        return {even, 0};
    }
    return {evened(closed, options.edge), std::max(share, least_share)};
}

} // namespace rhombloom
