#include "core/design/mesh_import/remesh_mesh.h"

#include <cmath>

namespace rhombloom {

using VertexHandle = EditMesh::VertexHandle;
using EdgeHandle = EditMesh::EdgeHandle;

EditMesh edit_mesh(const TriangleMesh& mesh)
{
    EditMesh result;
    for (const Vec3& p : mesh.points) {
        result.add_vertex(p);
    }
    for (const Triangle& t : mesh.triangles) {
        const auto f = result.add_face(VertexHandle(t[0]), VertexHandle(t[1]), VertexHandle(t[2]));
        expects(f.is_valid(), "edit_mesh: the mesh is an oriented manifold");
    }
    return result;
}

TriangleMesh triangle_mesh(EditMesh& mesh)
{
    mesh.garbage_collection();
    TriangleMesh result;
    for (const auto v : mesh.vertices()) {
        result.points.push_back(mesh.point(v));
    }
    for (const auto f : mesh.faces()) {
        Triangle t{};
        int k = 0;
        for (const auto v : mesh.fv_range(f)) {
            t[k++] = v.idx();
        }
        result.triangles.push_back(t);
    }
    return result;
}

double edge_length(const EditMesh& mesh, EdgeHandle e)
{
    const auto h = mesh.halfedge_handle(e, 0);
    return (mesh.point(mesh.to_vertex_handle(h)) - mesh.point(mesh.from_vertex_handle(h))).norm();
}

double mean_edge_length(const EditMesh& mesh)
{
    double sum = 0;
    int count = 0;
    for (const auto e : mesh.edges()) {
        sum += edge_length(mesh, e);
        ++count;
    }
    return count > 0 ? sum / count : 0;
}

std::array<VertexHandle, 2> opposite_vertices(const EditMesh& mesh, EdgeHandle e)
{
    return {mesh.to_vertex_handle(mesh.next_halfedge_handle(mesh.halfedge_handle(e, 0))),
            mesh.to_vertex_handle(mesh.next_halfedge_handle(mesh.halfedge_handle(e, 1)))};
}

bool may_flip(const EditMesh& mesh, EdgeHandle e)
{
    if (mesh.is_boundary(e) || !mesh.is_flip_ok(e)) {
        return false;
    }
    const auto h = mesh.halfedge_handle(e, 0);
    const Vec3& a = mesh.point(mesh.from_vertex_handle(h));
    const Vec3& b = mesh.point(mesh.to_vertex_handle(h));
    const auto [vc, vd] = opposite_vertices(mesh, e);
    const Vec3& c = mesh.point(vc);
    const Vec3& d = mesh.point(vd);
    const Vec3 before = (b - a).cross(c - a) + (d - a).cross(b - a);
    const Vec3 first = (d - a).cross(c - a);
    const Vec3 second = (c - b).cross(d - b);
    return first.dot(before) > 0 && second.dot(before) > 0;
}

bool may_move(const EditMesh& mesh, VertexHandle v, const Vec3& where, VertexHandle vanishing)
{
    const Vec3& here = mesh.point(v);
    for (const auto h : mesh.voh_range(v)) {
        if (mesh.is_boundary(h)) {
            continue;
        }
        const auto vb = mesh.to_vertex_handle(h);
        const auto vc = mesh.to_vertex_handle(mesh.next_halfedge_handle(h));
        if (vb == vanishing || vc == vanishing) {
            continue;
        }
        const Vec3 side = mesh.point(vc) - mesh.point(vb);
        const Vec3 old_normal = side.cross(here - mesh.point(vb));
        const Vec3 new_normal = side.cross(where - mesh.point(vb));
        constexpr double least_cosine = 0.1;
        if (new_normal.dot(old_normal) <= least_cosine * new_normal.norm() * old_normal.norm()) {
            return false;
        }
    }
    return true;
}

bool is_tip(const EditMesh& mesh, VertexHandle v)
{
    constexpr double pointed = radians(100);
    double left = two_pi;
    for (const auto h : mesh.voh_range(v)) {
        const Vec3 a = mesh.point(mesh.to_vertex_handle(h)) - mesh.point(v);
        const Vec3 b = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h))) - mesh.point(v);
        left -= std::atan2(a.cross(b).norm(), a.dot(b));
    }
    return left > pointed;
}

} // namespace rhombloom
