#include "core/design/mesh_import/network_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/design/mesh_import/curvature_match.h"
#include "core/design/mesh_import/join_network.h"
#include "core/design/mesh_import/network_trial.h"
#include "core/design/mesh_import/remesh.h"
#include "core/design/pose.h"
#include "core/text.h"

namespace rhombloom {

namespace {

constexpr double detail = 6;             // triangles' edges of the working target per edge of the network
constexpr double count_tolerance = 0.03; // of the number of elements
constexpr int relax_sweeps = 20;
constexpr std::size_t most_matched_vertices = 900; // of the triangulation; the misfit's matrix is dense

int max_degree(const Element& element)
{
    const double room = two_pi - permissible_defect(element).min;
    return static_cast<int>(std::floor(room / element.alpha + 1e-9));
}

//! The target in triangles that are small for the network and even: quick to ask, whatever the file had.
TriangleMesh even_target(const TriangleMesh& target, double edge)
{
    RemeshOptions options;
    options.edge = edge / detail;
    options.max_degree = 12;
    options.rounds = 3;
    return remesh(target, MeshTree(target), options);
}

int edge_count(const TriangleMesh& mesh)
{
    return static_cast<int>(mesh.triangles.size()) * 3 / 2;
}

//! Remesh until the number of edges is right; \p edge ends as the length that did it.
TriangleMesh remesh_to_count(const TriangleMesh& start, const MeshTree& target, int wanted, RemeshOptions options)
{
    constexpr int attempts = 5;
    TriangleMesh best = remesh(start, target, options);
    TriangleMesh last = best;
    for (int i = 0; i < attempts; ++i) {
        const double ratio = static_cast<double>(edge_count(last)) / wanted;
        const double best_ratio = static_cast<double>(edge_count(best)) / wanted;
        best = std::abs(ratio - 1) < std::abs(best_ratio - 1) ? last : best;
        if (std::abs(ratio - 1) < count_tolerance) {
            break;
        }
        options.rounds = 4;
        options.edge *= std::sqrt(ratio);
        last = remesh(last, target, options);
    }
    return with_edge_count(best, target, wanted, options);
}

//! Ever cooler: the first shake the triangulation, the last only improve it.
std::vector<MatchOptions> matchings(const RemeshOptions& remeshing)
{
    std::vector<MatchOptions> result;
    for (const double temperature : {2e-3, 3e-4}) {
        MatchOptions options;
        options.edge = remeshing.edge;
        options.max_degree = std::min(7, remeshing.max_degree);
        options.temperature = temperature;
        options.seed = static_cast<unsigned>(result.size() + 1);
        result.push_back(options);
    }
    return result;
}

} // namespace

double triangle_edge(const Element& element)
{
    constexpr double share = 0.97; // the bowed long sides pull at the diagonals
    return share * long_diagonal(element);
}

double area_per_element(double edge)
{
    return edge * edge * std::sqrt(3.0) / 6;
}

Expected<FoundNetwork> search_network(const TriangleMesh& target, const Element& element, const SearchOptions& options)
{
    const auto tell = [&](const std::string& what) { return !options.progress || options.progress(what); };
    tell("remeshing");
    RemeshOptions remeshing;
    remeshing.edge = triangle_edge(element);
    remeshing.max_degree = max_degree(element);
    const MeshTree tree(even_target(target, remeshing.edge));
    Trials trials{tree, element, options};
    std::optional<Trial> best;
    const auto consider = [&](const TriangleMesh& triangles) {
        auto trial = settle(triangles, triangle_middles(triangles, tree), trials);
        if (trial && (!best || trial->score < best->score)) {
            best = std::move(trial);
        }
    };
    for (const double share : {1.0, 1.06}) {
        RemeshOptions start = remeshing;
        start.edge *= share;
        TriangleMesh triangles = remesh_to_count(tree.mesh(), tree, options.elements, start);
        consider(triangles);
        relax_springs(triangles, tree, remeshing.edge, relax_sweeps);
        consider(triangles);
        for (const MatchOptions& matching : matchings(remeshing)) {
            if (!tell("matching curvature")) {
                return refuse("stopped");
            }
            if (triangles.points.size() <= most_matched_vertices) {
                match_curvature(triangles, tree, matching);
                consider(triangles);
            }
        }
    }
    if (best) {
        tell("easing the network");
        trials.max_iterations = 400; // from a settled network next to it
        polish(*best, trials, std::min(8, remeshing.max_degree));
    }
    if (!best || !best->found.embedding.converged) {
        return refuse("no network of " + std::to_string(options.elements) +
                      " elements comes to rest on this target: try more elements");
    }
    FoundNetwork found = std::move(best->found);
    found.embedding = embed_in_place(found.surface, element, options.embedding);
    found.target = tree.mesh();
    transform(found.target, found.target_scale, Vec3::Zero());
    return found;
}

} // namespace rhombloom
