#include "core/design/mesh_import/mesh_decimate.h"

#include <algorithm>
#include <cstdint>

#include "core/design/mesh_import/remesh_mesh.h"

namespace rhombloom {

namespace {

constexpr std::size_t most_triangles = 11; // at one point, or the neighbourhoods grow and with them the work

//! The bits of \p number, two zeros between them.
std::uint64_t spread_bits(std::uint64_t number, int bits)
{
    std::uint64_t result = 0;
    for (int k = 0; k < bits; ++k) {
        result |= (number >> k & 1) << 3 * k;
    }
    return result;
}

//! The same mesh, its points and triangles numbered along a space-filling curve (Morton 1966): what is near in space is
//! near in memory.
TriangleMesh in_spatial_order(const TriangleMesh& mesh)
{
    constexpr int bits = 16; // per axis
    const Eigen::AlignedBox3d box = bounds(mesh);
    const double cell = box.sizes().maxCoeff() / ((1 << bits) - 1);
    std::vector<std::pair<std::uint64_t, int>> order;
    order.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) {
        std::uint64_t code = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto number = static_cast<std::uint64_t>((p[axis] - box.min()[axis]) / cell);
            code |= spread_bits(number, bits) << axis;
        }
        order.emplace_back(code, static_cast<int>(order.size()));
    }
    std::sort(order.begin(), order.end());
    TriangleMesh result;
    std::vector<int> number(order.size());
    for (const auto& [code, point] : order) {
        number[point] = static_cast<int>(result.points.size());
        result.points.push_back(mesh.points[point]);
    }
    for (const Triangle& t : mesh.triangles) {
        Triangle numbered = {number[t[0]], number[t[1]], number[t[2]]};
        std::rotate(numbered.begin(), std::min_element(numbered.begin(), numbered.end()), numbered.end());
        result.triangles.push_back(numbered);
    }
    std::sort(result.triangles.begin(), result.triangles.end());
    return result;
}

bool too_long(const EditMesh& mesh, EditMesh::HalfedgeHandle h, double limit)
{
    const Vec3& where = mesh.point(mesh.to_vertex_handle(h));
    for (const auto v : mesh.vv_range(mesh.from_vertex_handle(h))) {
        if ((mesh.point(v) - where).squaredNorm() > limit * limit) {
            return true;
        }
    }
    return false;
}

bool may_collapse(EditMesh& mesh, EditMesh::HalfedgeHandle h, double limit)
{
    const auto gone = mesh.from_vertex_handle(h);
    const auto kept = mesh.to_vertex_handle(h);
    if (mesh.valence(gone) + mesh.valence(kept) > most_triangles + 4 || too_long(mesh, h, limit)) {
        return false;
    }
    for (const auto v : opposite_vertices(mesh, mesh.edge_handle(h))) {
        if (mesh.valence(v) <= 3) {
            return false;
        }
    }
    return mesh.is_collapse_ok(h) && may_move(mesh, gone, mesh.point(kept), kept);
}

//! One pass over all edges; returns how many went.
int collapse_pass(EditMesh& mesh, double edge)
{
    int collapsed = 0;
    const int count = static_cast<int>(mesh.n_edges());
    for (int i = 0; i < count; ++i) {
        const EditMesh::EdgeHandle e(i);
        for (int k = 0; k < 2 && !mesh.status(e).deleted() && edge_length(mesh, e) < edge; ++k) {
            const auto h = mesh.halfedge_handle(e, k);
            if (may_collapse(mesh, h, 1.6 * edge)) {
                mesh.collapse(h);
                ++collapsed;
            }
        }
    }
    mesh.garbage_collection();
    return collapsed;
}

} // namespace

TriangleMesh decimate(const TriangleMesh& mesh, double edge)
{
    constexpr double growth = 1.7; // of the shortest edge that stays, from pass to pass: triangles remain even
    constexpr double few = 0.02;
    constexpr std::size_t many = 200'000; // triangles: from then on most of the time goes by waiting for the memory
    EditMesh result = edit_mesh(mesh.triangles.size() > many ? in_spatial_order(mesh) : mesh);
    double limit = std::min(edge, 1.2 * mean_edge_length(result));
    for (bool last = false; !last;) {
        last = limit >= edge;
        while (collapse_pass(result, limit) > few * static_cast<double>(result.n_vertices())) {
        }
        limit = std::min(edge, growth * limit);
    }
    return triangle_mesh(result);
}

} // namespace rhombloom
