#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/design/mesh_import/network_trial.h"
#include "core/design/mesh_import/remesh_mesh.h"

namespace rhombloom {

namespace {

using VertexHandle = EditMesh::VertexHandle;
using EdgeHandle = EditMesh::EdgeHandle;

constexpr double least_gain = 1e-3; // of the score, la
constexpr double most_added = 0.02; // of the elements, by splits
constexpr int splits_per_place = 3; // the longest edges there
constexpr int flips_per_place = 8;  // the most regular ones there
constexpr double work = 30000;      // elements embedded in all trials together

struct Move
{
    int edge = 0;
    bool split = false;
    double rank = 0; //!< small ones are tried first
};

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

//! Flips and splits around the edge between two corners, the most promising first.
std::vector<Move> moves_near(const EditMesh& mesh, VertexHandle a, VertexHandle b, int max_degree, bool may_split)
{
    const auto h = mesh.find_halfedge(a, b);
    const auto [c, d] = opposite_vertices(mesh, mesh.edge_handle(h));
    std::set<int> edges;
    for (const VertexHandle v : {a, b, c, d}) {
        for (const auto e : mesh.ve_range(v)) {
            edges.insert(e.idx());
        }
    }
    std::vector<Move> flips;
    std::vector<Move> splits;
    for (const int e : edges) {
        if (may_flip(mesh, EdgeHandle(e)) && degrees_fit(mesh, EdgeHandle(e), max_degree)) {
            flips.push_back({e, false, static_cast<double>(irregularity(mesh, EdgeHandle(e)))});
        }
        splits.push_back({e, true, -edge_length(mesh, EdgeHandle(e))});
    }
    const auto before = [](const Move& x, const Move& y) {
        return std::tie(x.rank, x.edge) < std::tie(y.rank, y.edge);
    };
    std::sort(flips.begin(), flips.end(), before);
    std::sort(splits.begin(), splits.end(), before);
    flips.resize(std::min<std::size_t>(flips.size(), flips_per_place));
    splits.resize(may_split ? std::min<std::size_t>(splits.size(), splits_per_place) : 0);
    flips.insert(flips.begin() + std::min<std::ptrdiff_t>(3, static_cast<std::ptrdiff_t>(flips.size())), splits.begin(),
                 splits.end());
    return flips;
}

Triangle sorted(Triangle t)
{
    std::sort(t.begin(), t.end());
    return t;
}

std::optional<Trial> carry_out(const Move& move, const Trial& trial, const Trials& trials)
{
    EditMesh mesh = edit_mesh(trial.triangles);
    const EdgeHandle e(move.edge);
    if (move.split) {
        const auto h = mesh.halfedge_handle(e, 0);
        const Vec3 middle = (mesh.point(mesh.from_vertex_handle(h)) + mesh.point(mesh.to_vertex_handle(h))) / 2;
        mesh.split(e, mesh.add_vertex(middle));
    } else {
        mesh.flip(e);
    }
    std::map<Triangle, Vec3> known;
    for (std::size_t i = 0; i < trial.middles.size(); ++i) {
        known[sorted(trial.triangles.triangles[i])] = trial.middles[i];
    }
    const TriangleMesh changed = triangle_mesh(mesh);
    std::vector<Vec3> middles;
    for (const Triangle& t : changed.triangles) {
        const auto found = known.find(sorted(t));
        const Vec3 mean = (changed.points[t[0]] + changed.points[t[1]] + changed.points[t[2]]) / 3;
        middles.push_back(found == known.end() ? mean : found->second);
    }
    return settle(changed, middles, trials);
}

//! Elements to work at, the worst first: the overstretched, else those farthest from the target.
std::vector<int> trouble(const Trial& trial, const Trials& trials)
{
    const Surface& surface = trial.found.surface;
    const bool far_only = trial.score < 1;
    std::vector<double> badness;
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        const Vec3 middle =
            (surface.point(Vertex(q[0])) + surface.point(Vertex(q[2]))) / (2 * trial.found.target_scale);
        badness.push_back(far_only ? trials.target.nearest(middle).distance : trial.stretch[f.idx()]);
    }
    std::vector<int> order(badness.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return badness[a] > badness[b]; });
    constexpr std::size_t places = 12;
    order.resize(std::min(order.size(), places));
    return order;
}

//! The first move at this element that lowers the score, if one does before the budget is spent.
bool improve_at(int element, Trial& best, const Trials& trials, int max_degree, int& budget)
{
    const EditMesh mesh = edit_mesh(best.triangles);
    const Quad q = quad(best.found.surface, Face(element));
    const double room = (1 + most_added) * trials.options.elements;
    const bool may_split = static_cast<double>(best.found.surface.n_faces()) + 3 <= room;
    for (const Move& move : moves_near(mesh, VertexHandle(q[0]), VertexHandle(q[2]), max_degree, may_split)) {
        if (budget-- <= 0) {
            return false;
        }
        auto trial = carry_out(move, best, trials);
        if (trial && trial->score < best.score - least_gain) {
            best = std::move(*trial);
            return true;
        }
    }
    return false;
}

} // namespace

void polish(Trial& best, const Trials& trials, int max_degree)
{
    int budget = std::clamp(static_cast<int>(work / trials.options.elements), 20, 60);
    bool improved = true;
    while (improved && budget > 0) {
        improved = false;
        for (const int element : trouble(best, trials)) {
            if (improve_at(element, best, trials, max_degree, budget)) {
                improved = true;
                break;
            }
            if (budget <= 0) {
                break;
            }
        }
        if (trials.options.progress && !trials.options.progress("easing the network")) {
            return;
        }
    }
}

} // namespace rhombloom
