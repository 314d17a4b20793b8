#include "core/design/mesh_import/remesh.h"

#include <algorithm>
#include <cmath>

#include "core/design/mesh_import/remesh_mesh.h"

namespace rhombloom {

namespace {

using VertexHandle = EditMesh::VertexHandle;
using EdgeHandle = EditMesh::EdgeHandle;
using HalfedgeHandle = EditMesh::HalfedgeHandle;

constexpr double longest = 4.0 / 3;
constexpr double shortest = 4.0 / 5;

void split(EditMesh& mesh, const MeshTree& target, EdgeHandle e)
{
    const auto h = mesh.halfedge_handle(e, 0);
    const Vec3 middle = (mesh.point(mesh.from_vertex_handle(h)) + mesh.point(mesh.to_vertex_handle(h))) / 2;
    mesh.split(e, mesh.add_vertex(target.nearest(middle).point));
}

void split_long(EditMesh& mesh, const MeshTree& target, double edge)
{
    const int count = static_cast<int>(mesh.n_edges());
    for (int i = 0; i < count; ++i) {
        const EdgeHandle e(i);
        if (mesh.status(e).deleted() || edge_length(mesh, e) <= longest * edge) {
            continue;
        }
        split(mesh, target, e);
    }
}

//! Would the place of the vertex that \p h leaves be far from what is left? So limbs stay that are thinner than an
//! edge is long.
bool collapse_uncovers(const EditMesh& mesh, HalfedgeHandle h, double limit)
{
    const auto gone = mesh.from_vertex_handle(h);
    const auto kept = mesh.to_vertex_handle(h);
    const Vec3& p = mesh.point(gone);
    for (const auto out : mesh.voh_range(gone)) {
        const auto a = mesh.to_vertex_handle(out);
        const auto b = mesh.to_vertex_handle(mesh.next_halfedge_handle(out));
        if (a != kept && b != kept &&
            (nearest_on_triangle(p, mesh.point(kept), mesh.point(a), mesh.point(b)) - p).norm() <= limit) {
            return false;
        }
    }
    return true;
}

//! Would the vertex that \p h leaves, moved to the other end, have a side longer than \p limit or too high a degree?
bool collapse_spoils(const EditMesh& mesh, HalfedgeHandle h, double limit, int max_degree)
{
    const auto gone = mesh.from_vertex_handle(h);
    const auto kept = mesh.to_vertex_handle(h);
    for (const auto v : mesh.vv_range(gone)) {
        if ((mesh.point(v) - mesh.point(kept)).norm() > limit) {
            return true;
        }
    }
    const int degree = static_cast<int>(mesh.valence(gone) + mesh.valence(kept)) - 4;
    for (const auto v : opposite_vertices(mesh, mesh.edge_handle(h))) {
        if (mesh.valence(v) <= 3) {
            return true;
        }
    }
    return degree > max_degree || degree < 3;
}

//! Collapse \p e towards one of its ends, if that spoils nothing.
bool collapse(EditMesh& mesh, EdgeHandle e, double limit, int max_degree)
{
    constexpr double cover_share = 0.25; // of the longest side
    for (int k = 0; k < 2; ++k) {
        const auto h = mesh.halfedge_handle(e, k);
        const auto gone = mesh.from_vertex_handle(h);
        const auto kept = mesh.to_vertex_handle(h);
        if (mesh.is_collapse_ok(h) && !collapse_spoils(mesh, h, limit, max_degree) &&
            !collapse_uncovers(mesh, h, cover_share * limit) && may_move(mesh, gone, mesh.point(kept), kept)) {
            mesh.collapse(h);
            return true;
        }
    }
    return false;
}

void collapse_short(EditMesh& mesh, const RemeshOptions& options, double edge)
{
    for (int i = 0; i < static_cast<int>(mesh.n_edges()); ++i) {
        const EdgeHandle e(i);
        if (!mesh.status(e).deleted() && edge_length(mesh, e) < shortest * edge) {
            collapse(mesh, e, longest * edge, options.max_degree);
        }
    }
    mesh.garbage_collection();
}

//! All edges, the shortest first.
std::vector<EdgeHandle> by_length(const EditMesh& mesh)
{
    std::vector<std::pair<double, int>> sorted;
    for (const auto e : mesh.edges()) {
        sorted.emplace_back(edge_length(mesh, e), e.idx());
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<EdgeHandle> result;
    for (const auto& [length, index] : sorted) {
        result.emplace_back(index);
    }
    return result;
}

bool collapse_shortest(EditMesh& mesh, const RemeshOptions& options)
{
    constexpr double limit = 2; // edge lengths: the smoothing that follows evens them out
    for (const EdgeHandle e : by_length(mesh)) {
        if (collapse(mesh, e, limit * options.edge, options.max_degree)) {
            mesh.garbage_collection();
            return true;
        }
    }
    return false;
}

int excess(int degree)
{
    return (degree - 6) * (degree - 6);
}

//! Do the triangles at \p e lie about in one plane? Across a crease a flip would cut through the solid.
bool is_even(const EditMesh& mesh, EdgeHandle e)
{
    constexpr double least_cosine = 0.2;
    const auto h = mesh.halfedge_handle(e, 0);
    const Vec3& a = mesh.point(mesh.from_vertex_handle(h));
    const Vec3 side = mesh.point(mesh.to_vertex_handle(h)) - a;
    const auto [c, d] = opposite_vertices(mesh, e);
    const Vec3 left = side.cross(mesh.point(c) - a);
    const Vec3 right = (mesh.point(d) - a).cross(side);
    return left.dot(right) > least_cosine * left.norm() * right.norm();
}

void equalise_degrees(EditMesh& mesh, double edge)
{
    for (const auto e : mesh.edges()) {
        if (!may_flip(mesh, e) || !is_even(mesh, e)) {
            continue;
        }
        const auto h = mesh.halfedge_handle(e, 0);
        const std::array<VertexHandle, 2> ends = {mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)};
        const std::array<VertexHandle, 2> others = opposite_vertices(mesh, e);
        int before = 0;
        int after = 0;
        for (int k = 0; k < 2; ++k) {
            const int end = static_cast<int>(mesh.valence(ends[k]));
            const int other = static_cast<int>(mesh.valence(others[k]));
            before += excess(end) + excess(other);
            after += excess(end - 1) + excess(other + 1);
        }
        const double flipped = (mesh.point(others[0]) - mesh.point(others[1])).norm();
        if (after < before && flipped < 2 * edge) {
            mesh.flip(e);
        }
    }
}

void smooth(EditMesh& mesh, const MeshTree& target)
{
    for (const auto v : mesh.vertices()) {
        Vec3 sum = Vec3::Zero();
        Vec3 normal = Vec3::Zero();
        int count = 0;
        for (const auto h : mesh.voh_range(v)) {
            const Vec3& q = mesh.point(mesh.to_vertex_handle(h));
            const Vec3& r = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
            sum += q;
            normal += (q - mesh.point(v)).cross(r - mesh.point(v));
            ++count;
        }
        if (count == 0 || normal.norm() == 0 || is_tip(mesh, v)) {
            continue;
        }
        normal.normalize();
        Vec3 step = sum / count - mesh.point(v);
        step -= normal * normal.dot(step);
        const Vec3 where = target.nearest(mesh.point(v) + step).point;
        if (may_move(mesh, v, where, VertexHandle())) {
            mesh.set_point(v, where);
        }
    }
}

void round(EditMesh& mesh, const MeshTree& target, const RemeshOptions& options, double edge)
{
    split_long(mesh, target, edge);
    collapse_short(mesh, options, edge);
    equalise_degrees(mesh, edge);
    smooth(mesh, target);
}

//! Degrees and positions evened out, nothing added or taken away.
void even_out(EditMesh& mesh, const MeshTree& target, double edge, int rounds)
{
    for (int i = 0; i < rounds; ++i) {
        equalise_degrees(mesh, edge);
        smooth(mesh, target);
    }
}

} // namespace

TriangleMesh with_edge_count(const TriangleMesh& mesh, const MeshTree& target, int edges, const RemeshOptions& options)
{
    constexpr int per_step = 3; // edges that a split adds
    EditMesh result = edit_mesh(mesh);
    while (static_cast<int>(result.n_edges()) + per_step / 2 < edges) {
        split(result, target, by_length(result).back());
        even_out(result, target, options.edge, 1);
    }
    while (static_cast<int>(result.n_edges()) - per_step / 2 > edges && collapse_shortest(result, options)) {
        even_out(result, target, options.edge, 1);
    }
    even_out(result, target, options.edge, options.rounds);
    return triangle_mesh(result);
}

TriangleMesh remesh(const TriangleMesh& start, const MeshTree& target, const RemeshOptions& options)
{
    constexpr double growth = 1.5;
    EditMesh mesh = edit_mesh(start);
    double edge = std::min(options.edge, std::max(mean_edge_length(mesh), options.edge / 6));
    while (edge < options.edge) {
        round(mesh, target, options, edge);
        edge = std::min(growth * edge, options.edge);
    }
    for (int i = 0; i < options.rounds; ++i) {
        round(mesh, target, options, options.edge);
    }
    return triangle_mesh(mesh);
}

TriangleMesh evened(const MeshTree& mesh, double edge)
{
    RemeshOptions options;
    options.edge = edge;
    options.max_degree = 12;
    options.rounds = 3;
    constexpr double far = 4; // longer sides are not cut up within so few rounds
    EditMesh start = edit_mesh(mesh.mesh());
    for (std::size_t before = 0; before != start.n_edges();) {
        before = start.n_edges();
        split_long(start, mesh, far * edge);
    }
    return remesh(triangle_mesh(start), mesh, options);
}

} // namespace rhombloom
