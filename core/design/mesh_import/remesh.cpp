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
    for (int k = 0; k < 2; ++k) {
        const auto h = mesh.halfedge_handle(e, k);
        const auto gone = mesh.from_vertex_handle(h);
        const auto kept = mesh.to_vertex_handle(h);
        if (mesh.is_collapse_ok(h) && !collapse_spoils(mesh, h, limit, max_degree) &&
            may_move(mesh, gone, mesh.point(kept), kept)) {
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

void equalise_degrees(EditMesh& mesh, double edge)
{
    for (const auto e : mesh.edges()) {
        if (!may_flip(mesh, e)) {
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
        if (count == 0 || normal.norm() == 0) {
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

} // namespace rhombloom
