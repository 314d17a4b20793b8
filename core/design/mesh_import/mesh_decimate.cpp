#include "core/design/mesh_import/mesh_decimate.h"

#include <algorithm>
#include <cstddef>

#include <OpenMesh/Core/Utils/PropertyManager.hh>

#include "core/design/mesh_import/remesh_mesh.h"
#include "core/form/parallel.h"

namespace rhombloom {

namespace {

constexpr std::size_t most_triangles = 11; // at one point, or the neighbourhoods grow and with them the work

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

//! A rim stays: the part of the mesh beyond has it too.
bool may_collapse(EditMesh& mesh, EditMesh::HalfedgeHandle h, double limit)
{
    const auto gone = mesh.from_vertex_handle(h);
    const auto kept = mesh.to_vertex_handle(h);
    if (mesh.is_boundary(gone) || mesh.is_boundary(kept)) {
        return false;
    }
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

void collapse_short(EditMesh& mesh, double edge)
{
    constexpr double growth = 1.7; // of the shortest edge that stays, from pass to pass: triangles remain even
    constexpr double few = 0.02;
    double limit = std::min(edge, 1.2 * mean_edge_length(mesh));
    for (bool last = false; !last;) {
        last = limit >= edge;
        while (collapse_pass(mesh, limit) > few * static_cast<double>(mesh.n_vertices())) {
        }
        limit = std::min(edge, growth * limit);
    }
}

//! What is left of the triangles \p first to \p last of a mesh, when only points within them go.
std::vector<Triangle> decimated_part(const TriangleMesh& mesh, std::size_t first, std::size_t last, double edge)
{
    TriangleMesh part{{}, {mesh.triangles.begin() + first, mesh.triangles.begin() + last}};
    std::vector<int> points; // of the whole, by their number in the part
    for (const Triangle& t : part.triangles) {
        points.insert(points.end(), t.begin(), t.end());
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const int v : points) {
        part.points.push_back(mesh.points[v]);
    }
    for (Triangle& t : part.triangles) {
        for (int& v : t) {
            v = static_cast<int>(std::lower_bound(points.begin(), points.end(), v) - points.begin());
        }
    }
    EditMesh edited = edit_mesh(part);
    auto number = OpenMesh::makeTemporaryProperty<OpenMesh::VertexHandle, int>(edited);
    for (const auto v : edited.vertices()) {
        number[v] = points[v.idx()];
    }
    collapse_short(edited, edge);
    std::vector<Triangle> result = triangle_mesh(edited).triangles;
    for (Triangle& t : result) {
        for (int& v : t) {
            v = number[EditMesh::VertexHandle(v)];
        }
    }
    return result;
}

//! Of a large mesh whose triangles follow each other in space: parts of it side by side, which the caches hold.
TriangleMesh decimated_by_parts(const TriangleMesh& mesh, double edge)
{
    constexpr std::size_t part_size = 50'000;
    const std::size_t count = mesh.triangles.size() / part_size;
    std::vector<std::vector<Triangle>> parts(count);
    parallel_tasks(default_threads(), static_cast<int>(count), [&](int k) {
        parts[k] =
            decimated_part(mesh, k * mesh.triangles.size() / count, (k + 1) * mesh.triangles.size() / count, edge);
    });
    TriangleMesh result{mesh.points, {}};
    for (const std::vector<Triangle>& part : parts) {
        result.triangles.insert(result.triangles.end(), part.begin(), part.end());
    }
    drop_unused_points(result);
    return result;
}

} // namespace

TriangleMesh decimate(const TriangleMesh& mesh, double edge)
{
    constexpr std::size_t large = 200'000; // triangles
    EditMesh result = edit_mesh(mesh.triangles.size() > large ? decimated_by_parts(mesh, edge) : mesh);
    collapse_short(result, edge);
    return triangle_mesh(result);
}

} // namespace rhombloom
