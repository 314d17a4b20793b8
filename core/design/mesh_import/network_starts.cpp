#include "core/design/mesh_import/network_starts.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/design/mesh_import/curvature_match.h"
#include "core/design/mesh_import/join_network.h"
#include "core/design/mesh_import/remesh.h"
#include "core/form/parallel.h"

namespace rhombloom {

namespace {

constexpr double count_tolerance = 0.08;            // of the number of elements, after remeshing
constexpr double crowding = 1e-2;                   // stretches beyond 1 % are mostly where vertices of degree 7 crowd
constexpr std::size_t most_matched_vertices = 2500; // of the triangulation: a minute

int edge_count(const TriangleMesh& mesh)
{
    return static_cast<int>(mesh.triangles.size()) * 3 / 2;
}

//! Remesh until the number of edges is about right.
TriangleMesh remesh_to_count(const TriangleMesh& start, const MeshTree& target, int wanted, RemeshOptions options)
{
    constexpr int attempts = 4;
    TriangleMesh best = remesh(start, target, options);
    TriangleMesh last = best;
    for (int i = 0; i < attempts; ++i) {
        const double ratio = static_cast<double>(edge_count(last)) / wanted;
        const double best_ratio = static_cast<double>(edge_count(best)) / wanted;
        best = std::abs(ratio - 1) < std::abs(best_ratio - 1) ? last : best;
        if (std::abs(ratio - 1) < count_tolerance) {
            break;
        }
        options.edge *= std::sqrt(ratio);
        last = remesh(start, target, options); // anew: what has lost a limb does not get it back
    }
    return with_edge_count(best, target, wanted, options);
}

//! One remeshing and what is done to its curvature.
struct Variant
{
    double share = 1;       //!< of the triangles' edge length, while they are made
    double temperature = 0; //!< of the match
    double regularity = 0;
    unsigned seed = 1;
};

//! Four at a time; the later ones are for targets on which the first did not come to anything.
std::vector<Variant> variants(int attempt)
{
    constexpr double warm = 1e-2;
    constexpr double even = 1e-3;
    constexpr double further = 0.007;
    std::vector<Variant> result;
    for (const double share : {1.0, 1.06, 1.03, 0.97}) {
        const auto number = static_cast<int>(result.size());
        result.push_back({share + attempt * further, attempt % 2 == 0 ? warm : 4 * warm,
                          number % 2 == 0 ? even : 3 * even, static_cast<unsigned>(4 * attempt + number + 1)});
    }
    return result;
}

Plan plan_of(const TriangleMesh& triangles, const MeshTree& target)
{
    return {triangles, triangle_middles(triangles, target), {}, 1, triangles.points};
}

//! Of the price of degrees other than 6: in a large network it falls. The same misfit of lengths bends a surface off
//! its target by the same share of the target's size, so more elements come nearer only where more of them turn the
//! lattice. On spheres and eggs of 1,200 elements networks end 0.32 la off on the average with a quarter of the price,
//! 0.36 with all of it, and with less stretch; at 600 elements there is no such difference.
double regularity_share(int elements)
{
    constexpr double usual = 600;
    const double ratio = usual / elements;
    return std::min(1.0, ratio * ratio);
}

MatchOptions matching(const Trials& trials, const Variant& variant, double temperature, int rounds)
{
    MatchOptions options;
    options.edge = triangle_edge(trials.element);
    options.max_degree = std::min(7, max_degree(trials.element));
    options.temperature = temperature;
    options.rounds = rounds;
    options.regularity = variant.regularity * regularity_share(trials.options.elements);
    options.crowding = crowding;
    options.seed = variant.seed;
    return options;
}

//! Networks from one remeshing: as it is, and with its curvature matched; only those that settle.
std::vector<Trial> start(const Trials& trials, const Variant& variant)
{
    RemeshOptions remeshing;
    remeshing.edge = triangle_edge(trials.element) * variant.share;
    remeshing.max_degree = max_degree(trials.element);
    std::vector<Trial> result;
    const auto consider = [&](const TriangleMesh& triangles) {
        if (auto trial = settle(plan_of(triangles, trials.target), trials)) {
            result.push_back(std::move(*trial));
        }
    };
    constexpr int rounds = 30;
    const MeshTree& target = trials.target;
    const TriangleMesh remeshed = remesh_to_count(target.mesh(), target, trials.options.elements, remeshing);
    consider(remeshed);
    if (remeshed.points.size() <= most_matched_vertices) {
        // A little, for targets with deep hollows, which much would spoil; then as much as is possible, in two heats.
        TriangleMesh little = remeshed;
        match_curvature(little, target, matching(trials, variant, 3e-4, 3));
        consider(little);
        TriangleMesh matched = remeshed;
        for (const double cooler : {1.0, 0.2}) {
            match_curvature(matched, target, matching(trials, variant, cooler * variant.temperature, rounds));
            consider(matched);
        }
    }
    return result;
}

} // namespace

std::vector<Trial> starts(const Trials& trials, int attempt)
{
    const std::vector<Variant> all = variants(attempt);
    std::vector<std::vector<Trial>> found(all.size());
    parallel_tasks(default_threads(), static_cast<int>(all.size()), [&](int k) { found[k] = start(trials, all[k]); });
    std::vector<Trial> result;
    for (std::vector<Trial>& trial : found) { // in this order: the same every time
        std::move(trial.begin(), trial.end(), std::back_inserter(result));
    }
    return result;
}

} // namespace rhombloom
