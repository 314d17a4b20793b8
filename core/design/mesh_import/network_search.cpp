#include "core/design/mesh_import/network_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/design/mesh_import/curvature_match.h"
#include "core/design/mesh_import/join_network.h"
#include "core/design/mesh_import/remesh.h"
#include "core/design/pose.h"
#include "core/text.h"

namespace rhombloom {

namespace {

constexpr double stretch_limit = 0.0095;   // a little below what a sheet gives
constexpr double detail = 6;               // triangles' edges of the working target per edge of the network
constexpr double count_tolerance = 0.03;   // of the number of elements
constexpr int most_matched_vertices = 900; // of the triangulation; the misfit's matrix is dense

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

struct Search
{
    const MeshTree& target;
    const Element& element;
    const SearchOptions& options;
    std::optional<FoundNetwork> best;

    double score(const FoundNetwork& found) const
    {
        const double excess = std::max(0.0, found.embedding.max_stretch - stretch_limit);
        constexpr double price = 200; // la per unit of stretch beyond the limit
        return found.distance.rms() / element.la + (excess > 0 ? 1 + price * excess : 0) +
               (found.embedding.converged ? 0 : 100);
    }

    void consider(const TriangleMesh& triangles);
};

void Search::consider(const TriangleMesh& triangles)
{
    auto surface = make_surface(join_network(triangles, target));
    if (!surface) {
        return;
    }
    FoundNetwork found;
    EmbedOptions quick = options.embedding;
    quick.tolerance = 1e-6; // a candidate need not be exact
    found.embedding = embed_in_place(*surface, element, quick);
    const Eigen::Affine3d pose = fit(*surface, target, options.rescale);
    const double scale = std::cbrt(pose.linear().determinant());
    found.target_scale = 1 / scale;
    found.surface = std::move(*surface);
    for (const Vertex v : found.surface.vertices()) {
        found.surface.set_point(v, pose * found.surface.point(v));
    }
    found.distance = distance(found.surface, target);
    // Measured on the target as it was; all lengths now grow so that the elements have their own size again.
    for (const Vertex v : found.surface.vertices()) {
        found.surface.set_point(v, found.surface.point(v) / scale);
    }
    for (Deviation* d : {&found.distance.to_target, &found.distance.from_target}) {
        d->rms /= scale;
        d->max /= scale;
    }
    if (!best || score(found) < score(*best)) {
        best = std::move(found);
    }
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
    constexpr int attempts = 10;
    constexpr double first_temperature = 5e-3;
    const auto tell = [&](const std::string& what) { return !options.progress || options.progress(what); };
    RemeshOptions remeshing;
    remeshing.edge = triangle_edge(element);
    remeshing.max_degree = max_degree(element);
    tell("remeshing");
    const MeshTree tree(even_target(target, remeshing.edge));
    TriangleMesh triangles = remesh_to_count(tree.mesh(), tree, options.elements, remeshing);
    relax_springs(triangles, tree, remeshing.edge, 20);
    Search search{tree, element, options, std::nullopt};
    search.consider(triangles);
    MatchOptions matching;
    matching.edge = remeshing.edge;
    matching.max_degree = std::min(7, remeshing.max_degree);
    matching.temperature = first_temperature;
    const bool matchable = triangles.points.size() <= most_matched_vertices;
    for (int i = 0; i < attempts && matchable; ++i) {
        if (!tell("network " + std::to_string(i + 1) + " of " + std::to_string(attempts))) {
            return refuse("stopped");
        }
        match_curvature(triangles, tree, matching);
        search.consider(triangles);
        matching.temperature *= 0.5;
        ++matching.seed;
    }
    if (!search.best || !search.best->embedding.converged) {
        return refuse("no network of " + std::to_string(options.elements) +
                      " elements comes to rest on this target: try more elements");
    }
    search.best->embedding = embed_in_place(search.best->surface, element, options.embedding);
    search.best->target = tree.mesh();
    transform(search.best->target, search.best->target_scale, Vec3::Zero());
    return std::move(*search.best);
}

} // namespace rhombloom
