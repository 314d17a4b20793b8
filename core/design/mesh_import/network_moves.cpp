#include "core/design/mesh_import/network_moves.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/design/mesh_import/remesh_mesh.h"

namespace rhombloom {

namespace {

using VertexHandle = EditMesh::VertexHandle;
using EdgeHandle = EditMesh::EdgeHandle;

constexpr std::size_t most_splits = 4;
constexpr std::size_t most_collapses = 2;
constexpr double most_changed = 0.04; // of the number of elements asked for
constexpr int per_change = 3;         // elements that a split adds and a collapse takes away

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

//! Would one corner in place of two leave degrees of 4 and more, and is it a surface still?
bool may_collapse(EditMesh& mesh, EdgeHandle e, int max_degree)
{
    const auto h = mesh.halfedge_handle(e, 0);
    const auto [c, d] = opposite_vertices(mesh, e);
    const int joined =
        static_cast<int>(mesh.valence(mesh.from_vertex_handle(h)) + mesh.valence(mesh.to_vertex_handle(h))) - 4;
    return joined >= 4 && joined <= max_degree && mesh.valence(c) > 4 && mesh.valence(d) > 4 && mesh.is_collapse_ok(h);
}

//! The first few of \p sorted among the others, the more the later.
void take_first(std::vector<Ranked>& sorted, std::size_t count, double rank, std::vector<Ranked>& ranked)
{
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < std::min(count, sorted.size()); ++k) {
        ranked.push_back({rank + 2 * static_cast<double>(k), sorted[k].move});
    }
}

//! The element's nodes and those around them.
std::vector<Move> pops_near(const EditMesh& mesh, const Corners& place)
{
    const auto h = mesh.find_halfedge(VertexHandle(place.first), VertexHandle(place.second));
    const auto [c, d] = opposite_vertices(mesh, mesh.edge_handle(h));
    std::set<int> nodes;
    const int corners = static_cast<int>(mesh.n_vertices());
    for (const VertexHandle v : {VertexHandle(place.first), VertexHandle(place.second), c, d}) {
        nodes.insert(v.idx());
        for (const auto f : mesh.vf_range(v)) {
            nodes.insert(corners + f.idx());
        }
    }
    std::vector<Move> result;
    for (const int v : nodes) {
        result.push_back({Move::Kind::Pop, {v, v}});
    }
    return result;
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

MoveLimits move_limits(const Trial& trial, const Trials& trials)
{
    const double asked = trials.options.elements;
    const auto count = static_cast<double>(trial.ratings.size());
    return {max_move_degree(trials.element), count + per_change <= (1 + most_changed) * asked,
            count - per_change >= (1 - most_changed) * asked};
}

bool keeps_count(const Trial& changed, const Trial& before, const Trials& trials)
{
    const double asked = trials.options.elements;
    const auto off = [&](const Trial& trial) { return std::abs(static_cast<double>(trial.ratings.size()) - asked); };
    return off(changed) <= std::max(most_changed * asked, off(before));
}

std::vector<Move> moves_near(const Plan& plan, const Corners& place, const MoveLimits& limits)
{
    constexpr double split_rank = 4; // between flips that leave degrees 5 and 7 and those that leave worse ones
    constexpr double collapse_rank = 5;
    constexpr double turn_rank = 6;
    EditMesh mesh = edit_mesh(plan.triangles);
    std::vector<Ranked> ranked;
    std::vector<Ranked> splits;
    std::vector<Ranked> collapses;
    for (const int index : edges_near(mesh, place)) {
        const EdgeHandle e(index);
        const Corners corners = corners_of(mesh, e);
        if (may_flip(mesh, e) && degrees_fit(mesh, e, limits.max_degree)) {
            ranked.push_back({static_cast<double>(irregularity(mesh, e)), {Move::Kind::Flip, corners}});
        }
        if (limits.may_split) {
            splits.push_back({-edge_length(mesh, e), {Move::Kind::Split, corners}});
        }
        if (limits.may_collapse && may_collapse(mesh, e, limits.max_degree)) {
            collapses.push_back({edge_length(mesh, e), {Move::Kind::Collapse, corners}});
        }
        if (corners == place || plan.flipped.count(corners) > 0) {
            ranked.push_back({turn_rank, {Move::Kind::Turn, corners}});
        }
    }
    take_first(splits, most_splits, split_rank, ranked);
    take_first(collapses, most_collapses, collapse_rank, ranked);
    std::sort(ranked.begin(), ranked.end());
    std::vector<Move> result;
    for (const Ranked& r : ranked) {
        result.push_back(r.move);
    }
    if (limits.may_pop) {
        const std::vector<Move> pops = pops_near(mesh, place);
        result.insert(result.end(), pops.begin(), pops.end());
    }
    return result;
}

namespace {

Triangle sorted(Triangle t)
{
    std::sort(t.begin(), t.end());
    return t;
}

//! \p point on the other side of the plane of a closed ring of points.
Vec3 mirrored(const Vec3& point, const std::vector<Vec3>& ring)
{
    Vec3 middle = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 0; k < ring.size(); ++k) {
        middle += ring[k] / static_cast<double>(ring.size());
        normal += (ring[k] - ring[0]).cross(ring[(k + 1) % ring.size()] - ring[0]);
    }
    return point - 2 * normal * normal.dot(point - middle) / std::max(normal.squaredNorm(), 1e-300);
}

void pop(int node, Plan& plan)
{
    const int corners = static_cast<int>(plan.triangles.points.size());
    std::vector<Vec3> ring;
    if (node >= corners) {
        for (const int v : plan.triangles.triangles[node - corners]) {
            ring.push_back(plan.triangles.points[v]);
        }
        plan.middles[node - corners] = mirrored(plan.middles[node - corners], ring);
        return;
    }
    const EditMesh mesh = edit_mesh(plan.triangles);
    for (const auto f : mesh.vf_range(VertexHandle(node))) {
        ring.push_back(plan.middles[f.idx()]);
    }
    plan.triangles.points[node] = mirrored(plan.triangles.points[node], ring);
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
    const Vec3 middle = (mesh.point(mesh.from_vertex_handle(h)) + mesh.point(mesh.to_vertex_handle(h))) / 2;
    if (move.kind == Move::Kind::Split) {
        mesh.split(e, mesh.add_vertex(middle));
    } else if (move.kind == Move::Kind::Collapse && mesh.is_collapse_ok(h)) {
        mesh.set_point(mesh.to_vertex_handle(h), middle);
        mesh.collapse(h);
    } else if (move.kind == Move::Kind::Flip && mesh.is_flip_ok(e)) {
        mesh.flip(e);
    }
    flipped.erase(move.corners);
}

//! New numbers of the corners, without those that collapsed: -1 for them.
std::vector<int> numbers(const EditMesh& mesh)
{
    std::vector<int> result;
    int next = 0;
    for (int v = 0; v < static_cast<int>(mesh.n_vertices()); ++v) {
        result.push_back(mesh.status(VertexHandle(v)).deleted() ? -1 : next++);
    }
    return result;
}

//! Where a corner is meant to be; a new one in the middle of those around it.
Vec3 meant(VertexHandle v, const EditMesh& mesh, const Plan& plan)
{
    if (v.idx() < static_cast<int>(plan.meant.size())) {
        return plan.meant[v.idx()];
    }
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const auto w : mesh.vv_range(v)) {
        if (w.idx() < static_cast<int>(plan.meant.size())) {
            sum += plan.meant[w.idx()];
            ++count;
        }
    }
    return sum / std::max(count, 1);
}

} // namespace

Plan carry_out(const std::vector<Move>& moves, const Plan& before)
{
    Plan plan = before;
    for (const Move& move : moves) {
        if (move.kind == Move::Kind::Pop) {
            pop(move.corners.first, plan);
        }
    }
    EditMesh mesh = edit_mesh(plan.triangles);
    std::set<Corners> flipped = plan.flipped;
    for (const Move& move : moves) {
        if (move.kind == Move::Kind::Pop) {
            continue;
        }
        apply(move, mesh, flipped);
    }
    std::map<Triangle, Vec3> known;
    for (std::size_t i = 0; i < plan.middles.size(); ++i) {
        known[sorted(plan.triangles.triangles[i])] = plan.middles[i];
    }
    const std::vector<int> number = numbers(mesh);
    Plan result;
    result.scale = plan.scale;
    for (const auto v : mesh.vertices()) { // leaves out what collapsed
        result.triangles.points.push_back(mesh.point(v));
        if (!plan.origin.empty()) {
            const auto k = static_cast<std::size_t>(v.idx());
            result.origin.push_back(k < plan.origin.size() ? plan.origin[k] : -1);
        }
    }
    if (!plan.meant.empty()) {
        for (const auto v : mesh.vertices()) {
            result.meant.push_back(meant(v, mesh, plan));
        }
    }
    for (const auto f : mesh.faces()) {
        Triangle t{};
        Vec3 sum = Vec3::Zero();
        int k = 0;
        for (const auto v : mesh.fv_range(f)) {
            t[k++] = v.idx();
            sum += mesh.point(v);
        }
        const auto found = known.find(sorted(t));
        result.middles.push_back(found == known.end() ? Vec3(sum / 3) : found->second);
        result.triangles.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
    for (const auto& [a, b] : flipped) {
        if (number[a] >= 0 && number[b] >= 0) {
            result.flipped.insert(std::minmax(number[a], number[b]));
        }
    }
    return result;
}

} // namespace rhombloom
