#include "core/design/mesh_import/network_trial.h"

#include <algorithm>
#include <cmath>

#include "core/design/mesh_import/join_network.h"
#include "core/design/pose.h"
#include "core/model/validity.h"

namespace rhombloom {

namespace {

constexpr double stretch_limit = 0.0092; // a little below the hundredth that a sheet gives

std::vector<double> element_stretch(const Surface& surface, const Element& element)
{
    std::vector<double> result;
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        const auto length = [&](int a, int b) {
            return (surface.point(Vertex(q[a])) - surface.point(Vertex(q[b]))).norm();
        };
        // Networks from joins: the first and third corner are acute.
        double largest = std::max(length(0, 2) / long_diagonal(element), length(1, 3) / short_diagonal(element));
        for (int k = 0; k < 4; ++k) {
            largest = std::max(largest, length(k, (k + 1) % 4) / element.la);
        }
        result.push_back(largest - 1);
    }
    return result;
}

double score(const Trial& trial, const Element& element)
{
    constexpr double price = 25; // la per unit of stretch beyond the limit, summed over the elements
    constexpr double unbuildable = 1;
    double excess = 0;
    for (const double s : trial.stretch) {
        excess += std::max(0.0, s - stretch_limit);
    }
    return trial.found.distance.rms() / element.la + (excess > 0 ? unbuildable + price * excess : 0) +
           (trial.found.embedding.converged ? 0 : 100);
}

bool permissible(const Surface& surface, const Element& element)
{
    return std::all_of(surface.vertices_begin(), surface.vertices_end(),
                       [&](Vertex v) { return surface.is_boundary(v) || defect_problem(surface, element, v).empty(); });
}

void scale_about_origin(Surface& surface, double factor)
{
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, factor * surface.point(v));
    }
}

} // namespace

std::optional<Trial> settle(const TriangleMesh& triangles, const std::vector<Vec3>& middles, const Trials& trials)
{
    auto surface = make_surface(join_network(triangles, middles));
    if (!surface || !permissible(*surface, trials.element)) {
        return std::nullopt;
    }
    Trial trial;
    EmbedOptions quick = trials.options.embedding;
    quick.tolerance = 1e-6; // a trial need not be exact
    quick.max_iterations = trials.max_iterations;
    trial.found.embedding = embed_in_place(*surface, trials.element, quick);
    trial.stretch = element_stretch(*surface, trials.element);
    const Eigen::Affine3d pose = fit(*surface, trials.target, trials.options.rescale);
    for (const Vertex v : surface->vertices()) {
        surface->set_point(v, pose * surface->point(v));
    }
    trial.found.distance = distance(*surface, trials.target);
    trial.triangles.triangles = triangles.triangles;
    for (const Vertex v : surface->vertices()) {
        const bool corner = v.idx() < static_cast<int>(triangles.points.size());
        (corner ? trial.triangles.points : trial.middles).push_back(surface->point(v));
    }
    // All lengths grow so that the elements have their own size again, and the target with them.
    const double scale = std::cbrt(pose.linear().determinant());
    scale_about_origin(*surface, 1 / scale);
    for (Deviation* d : {&trial.found.distance.to_target, &trial.found.distance.from_target}) {
        d->rms /= scale;
        d->max /= scale;
    }
    trial.found.target_scale = 1 / scale;
    trial.found.surface = std::move(*surface);
    trial.score = score(trial, trials.element);
    return trial;
}

} // namespace rhombloom
