#include "core/design/mesh_import/network_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/design/mesh_import/curvature_match.h"
#include "core/design/mesh_import/join_network.h"
#include "core/design/mesh_import/mesh_decimate.h"
#include "core/design/mesh_import/network_crossings.h"
#include "core/design/mesh_import/network_trial.h"
#include "core/design/mesh_import/remesh.h"
#include "core/design/pose.h"
#include "core/form/parallel.h"
#include "core/text.h"

namespace rhombloom {

namespace {

constexpr double detail = 6;                       // triangles' edges of the working target per edge of the network
constexpr double count_tolerance = 0.03;           // of the number of elements
constexpr double stretch_price = 25;               // la per unit of stretch beyond the limit, summed over the elements
constexpr std::size_t most_matched_vertices = 900; // of the triangulation; the misfit's matrix is dense

//! The target in triangles that are small for the network and even: quick to ask, whatever the file had.
TriangleMesh even_target(const TriangleMesh& target, double edge)
{
    RemeshOptions options;
    options.edge = edge / detail;
    options.max_degree = 12;
    options.rounds = 3;
    const MeshTree reduced(decimate(target, edge / (2 * detail)));
    return remesh(reduced.mesh(), reduced, options);
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

namespace {

Plan plan_of(const TriangleMesh& triangles, const MeshTree& target)
{
    return {triangles, triangle_middles(triangles, target), {}};
}

bool is_better(const Trial& a, const Trial& b)
{
    return score(a, stretch_price) < score(b, stretch_price);
}

//! Networks from one remeshing: as it is, and with its curvature matched; only those that settle.
std::vector<Trial> start(const Trials& trials, double share)
{
    RemeshOptions remeshing;
    remeshing.edge = triangle_edge(trials.element) * share;
    remeshing.max_degree = max_degree(trials.element);
    std::vector<Trial> result;
    const auto consider = [&](const TriangleMesh& triangles) {
        if (auto trial = settle(plan_of(triangles, trials.target), trials)) {
            result.push_back(std::move(*trial));
        }
    };
    const MeshTree& target = trials.target;
    TriangleMesh triangles = remesh_to_count(target.mesh(), target, trials.options.elements, remeshing);
    consider(triangles);
    remeshing.edge = triangle_edge(trials.element);
    for (const MatchOptions& matching : matchings(remeshing)) {
        if (triangles.points.size() <= most_matched_vertices) {
            match_curvature(triangles, target, matching);
            consider(triangles);
        }
    }
    std::stable_sort(result.begin(), result.end(), is_better);
    return result;
}

//! The best network of each of several remeshings, the best first.
std::vector<Trial> starts(const Trials& trials)
{
    const std::vector<double> shares = {1.0, 1.06, 1.03, 0.97};
    std::vector<std::vector<Trial>> found(shares.size());
    parallel_tasks(default_threads(), static_cast<int>(shares.size()),
                   [&](int k) { found[k] = start(trials, shares[k]); });
    std::vector<Trial> result;
    for (std::vector<Trial>& trial : found) {
        if (!trial.empty()) {
            result.push_back(std::move(trial.front()));
        }
    }
    std::stable_sort(result.begin(), result.end(), is_better);
    return result;
}

} // namespace

Expected<FoundNetwork> search_network(const TriangleMesh& target, const Element& element, const SearchOptions& options)
{
    const auto tell = [&](const std::string& what) { return !options.progress || options.progress(what); };
    tell("simplifying the target");
    const MeshTree tree(even_target(target, triangle_edge(element)));
    if (!tell("remeshing")) {
        return refuse("stopped");
    }
    Trials trials{tree, element, options};
    std::vector<Trial> found = starts(trials);
    if (found.empty()) {
        return refuse("no network of " + std::to_string(options.elements) +
                      " elements comes to rest on this target: try more elements");
    }
    constexpr std::size_t finalists = 2;
    const long work = 15000L * options.elements; // iterations times elements
    found.resize(std::min(found.size(), finalists));
    for (Trial& trial : found) {
        polish(trial, trials, stretch_price, work);
    }
    std::stable_sort(found.begin(), found.end(), [](const Trial& a, const Trial& b) {
        return std::pair(has_crossings(a.found.surface), score(a, stretch_price)) <
               std::pair(has_crossings(b.found.surface), score(b, stretch_price));
    });
    Trial& best = found.front();
    polish(best, trials, 4 * stretch_price, work);
    FoundNetwork network = std::move(best.found);
    EmbedOptions exact = options.embedding;
    exact.start = Start::Edited;
    network.embedding = embed_in_place(network.surface, element, exact);
    network.target = tree.mesh();
    transform(network.target, network.target_scale, Vec3::Zero());
    return network;
}

} // namespace rhombloom
