#include "core/design/mesh_import/network_moves.h"

#include <algorithm>
#include <map>

#include "core/design/mesh_import/remesh_mesh.h"

namespace rhombloom {

namespace {

using VertexHandle = EditMesh::VertexHandle;
using EdgeHandle = EditMesh::EdgeHandle;

constexpr std::size_t most_splits = 4;

struct Ranked
{
    double rank = 0; //!< small ones are tried first
    Move move;

    bool operator<(const Ranked& other) const
    {
        return std::tie(rank, move.corners) < std::tie(other.rank, other.move.corners);
    }
};

Corners corners_of(const EditMesh& mesh, EdgeHandle e)
{
    const auto h = mesh.halfedge_handle(e, 0);
    return std::minmax(mesh.from_vertex_handle(h).idx(), mesh.to_vertex_handle(h).idx());
}

int irregularity(const EditMesh& mesh, EdgeHandle e)
{
    const auto h = mesh.halfedge_handle(e, 0);
    const auto [c, d] = opposite_vertices(mesh, e);
    int sum = 0;
    for (const auto& [v, step] : {std::pair(mesh.from_vertex_handle(h), -1), std::pair(mesh.to_vertex_handle(h), -1),
                                  std::pair(c, 1), std::pair(d, 1)}) {
        const int off = static_cast<int>(mesh.valence(v)) + step - 6;
        sum += off * off;
    }
    return sum;
}

bool degrees_fit(const EditMesh& mesh, EdgeHandle e, int max_degree)
{
    const auto h = mesh.halfedge_handle(e, 0);
    const auto [c, d] = opposite_vertices(mesh, e);
    return mesh.valence(mesh.from_vertex_handle(h)) > 4 && mesh.valence(mesh.to_vertex_handle(h)) > 4 &&
           static_cast<int>(mesh.valence(c)) < max_degree && static_cast<int>(mesh.valence(d)) < max_degree;
}

std::set<int> edges_near(const EditMesh& mesh, const Corners& place)
{
    const auto h = mesh.find_halfedge(VertexHandle(place.first), VertexHandle(place.second));
    expects(h.is_valid(), "moves_near: the place is an element of the plan");
    const auto [c, d] = opposite_vertices(mesh, mesh.edge_handle(h));
    std::set<int> edges;
    for (const VertexHandle v : {VertexHandle(place.first), VertexHandle(place.second), c, d}) {
        for (const auto e : mesh.ve_range(v)) {
            edges.insert(e.idx());
        }
    }
    return edges;
}

} // namespace

std::vector<Move> moves_near(const Plan& plan, const Corners& place, const MoveLimits& limits)
{
    constexpr double split_rank = 4; // between flips that leave degrees 5 and 7 and those that leave worse ones
    constexpr double turn_rank = 6;
    const EditMesh mesh = edit_mesh(plan.triangles);
    std::vector<Ranked> ranked;
    std::vector<Ranked> splits;
    for (const int index : edges_near(mesh, place)) {
        const EdgeHandle e(index);
        const Corners corners = corners_of(mesh, e);
        if (may_flip(mesh, e) && degrees_fit(mesh, e, limits.max_degree)) {
            ranked.push_back({static_cast<double>(irregularity(mesh, e)), {Move::Kind::Flip, corners}});
        }
        if (limits.may_split) {
            splits.push_back({-edge_length(mesh, e), {Move::Kind::Split, corners}});
        }
        if (corners == place || plan.flipped.count(corners) > 0) {
            ranked.push_back({turn_rank, {Move::Kind::Turn, corners}});
        }
    }
    std::sort(splits.begin(), splits.end());
    splits.resize(std::min(splits.size(), most_splits));
    for (std::size_t k = 0; k < splits.size(); ++k) {
        ranked.push_back({split_rank + 2 * static_cast<double>(k), splits[k].move});
    }
    std::sort(ranked.begin(), ranked.end());
    std::vector<Move> result;
    for (const Ranked& r : ranked) {
        result.push_back(r.move);
    }
    return result;
}

namespace {

Triangle sorted(Triangle t)
{
    std::sort(t.begin(), t.end());
    return t;
}

void apply(const Move& move, EditMesh& mesh, std::set<Corners>& flipped)
{
    if (move.kind == Move::Kind::Turn) {
        if (flipped.erase(move.corners) == 0) {
            flipped.insert(move.corners);
        }
        return;
    }
    const auto h = mesh.find_halfedge(VertexHandle(move.corners.first), VertexHandle(move.corners.second));
    if (!h.is_valid()) {
        return;
    }
    const EdgeHandle e = mesh.edge_handle(h);
    if (move.kind == Move::Kind::Split) {
        const Vec3 middle = (mesh.point(mesh.from_vertex_handle(h)) + mesh.point(mesh.to_vertex_handle(h))) / 2;
        mesh.split(e, mesh.add_vertex(middle));
    } else if (mesh.is_flip_ok(e)) {
        mesh.flip(e);
    }
    flipped.erase(move.corners);
}

} // namespace

Plan carry_out(const std::vector<Move>& moves, const Plan& plan)
{
    EditMesh mesh = edit_mesh(plan.triangles);
    Plan result;
    result.flipped = plan.flipped;
    for (const Move& move : moves) {
        apply(move, mesh, result.flipped);
    }
    std::map<Triangle, Vec3> known;
    for (std::size_t i = 0; i < plan.middles.size(); ++i) {
        known[sorted(plan.triangles.triangles[i])] = plan.middles[i];
    }
    result.triangles = triangle_mesh(mesh);
    const std::vector<Vec3>& points = result.triangles.points;
    for (const Triangle& t : result.triangles.triangles) {
        const auto found = known.find(sorted(t));
        result.middles.push_back(found == known.end() ? Vec3((points[t[0]] + points[t[1]] + points[t[2]]) / 3)
                                                      : found->second);
    }
    return result;
}

} // namespace rhombloom
