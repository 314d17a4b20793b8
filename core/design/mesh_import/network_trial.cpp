#include "core/design/mesh_import/network_trial.h"

#include <algorithm>
#include <cmath>

#include "core/design/mesh_import/join_network.h"
#include "core/design/mesh_import/network_bends.h"
#include "core/design/mesh_import/network_crossings.h"
#include "core/design/pose.h"
#include "core/model/element_stretch.h"
#include "core/model/validity.h"

namespace rhombloom {

namespace {

constexpr double stretch_limit = 0.0095; // a little below the hundredth that a sheet gives
constexpr int trial_samples = 2000;

void scale_about_origin(Surface& surface, double factor)
{
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, factor * surface.point(v));
    }
}

void rate_elements(const Surface& surface, const Trials& trials, Trial& trial)
{
    trial.ratings.resize(surface.n_faces());
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        Vec3 sum = Vec3::Zero();
        for (const int v : q) {
            sum += surface.point(Vertex(v));
        }
        ElementRating& rating = trial.ratings[f.idx()];
        rating.middle = sum / 4;
        rating.distance = trials.target.nearest(rating.middle).distance / trials.element.la;
    }
}

//! After the trial's plan and surface.
void rate_bends(const Trials& trials, Trial& trial)
{
    const Plan& plan = trial.plan;
    if (plan.meant.empty()) {
        return;
    }
    const std::vector<Eigen::Matrix3d> turned = turns(plan.triangles, plan.meant);
    for (const Face f : trial.found.surface.faces()) {
        const Quad q = quad(trial.found.surface, f);
        trial.ratings[f.idx()].bend = (turned[q[0]] - turned[q[2]]).squaredNorm();
    }
    trial.astray = astray(plan.triangles.points, plan.meant, trials.options.rescale) / plan.scale / trials.element.la;
}

EmbedReport embed_quickly(Surface& surface, const Trials& trials)
{
    EmbedOptions quick = trials.options.embedding;
    quick.tolerance = 1e-5;      // a trial need not be exact
    quick.start = Start::Edited; // the target's creases are meant
    quick.max_iterations = trials.max_iterations;
    quick.threads = 1; // several trials run side by side
    return embed_in_place(surface, trials.element, quick);
}

} // namespace

bool has_permissible_defects(const Surface& surface, const Element& element)
{
    return std::all_of(surface.vertices_begin(), surface.vertices_end(),
                       [&](Vertex v) { return surface.is_boundary(v) || defect_problem(surface, element, v).empty(); });
}

Expected<Surface> surface_of(const Plan& plan)
{
    SurfaceLists lists = join_network(plan.triangles, plan.middles);
    for (std::size_t f = 0; f < lists.quads.size(); ++f) {
        const Quad& q = lists.quads[f];
        lists.facing[f] = plan.flipped.count(std::minmax(q[0], q[2])) > 0 ? Facing::Back : Facing::Front;
    }
    return make_surface(lists);
}

int max_degree(const Element& element)
{
    const double room = two_pi - permissible_defect(element).min;
    return static_cast<int>(std::floor(room / element.alpha + 1e-9));
}

int max_move_degree(const Element& element)
{
    return std::min(8, max_degree(element));
}

bool is_permissible(const Plan& plan, const Trials& trials)
{
    const auto surface = surface_of(plan);
    return surface && has_permissible_defects(*surface, trials.element);
}

double excess_stretch(double stretch)
{
    return std::max(0.0, stretch - stretch_limit);
}

bool can_be_built(const Trial& trial)
{
    constexpr double most_stretch = 0.0099; // a little below the hundredth that a sheet gives: a trial is not exact
    return std::all_of(trial.ratings.begin(), trial.ratings.end(),
                       [](const ElementRating& rating) { return rating.stretch < most_stretch; }) &&
           !has_crossings(trial.found.surface);
}

double score(const Trial& trial, double price)
{
    return trial.rms + price * trial.excess;
}

std::optional<Trial> settle(const Plan& plan, const Trials& trials)
{
    auto surface = surface_of(plan);
    if (!surface || !has_permissible_defects(*surface, trials.element)) {
        return std::nullopt;
    }
    Trial trial;
    scale_about_origin(*surface, 1 / plan.scale); // so what was in equilibrium still is
    trial.found.embedding = embed_quickly(*surface, trials);
    if (!trial.found.embedding.converged) {
        return std::nullopt;
    }
    std::vector<double> stretch;
    for (const Face f : surface->faces()) {
        stretch.push_back(element_stretch(*surface, trials.element, f));
        trial.excess += excess_stretch(stretch.back());
    }
    scale_about_origin(*surface, plan.scale);
    const Eigen::Affine3d pose = fit(*surface, trials.target, trials.options.rescale);
    for (const Vertex v : surface->vertices()) {
        surface->set_point(v, pose * surface->point(v));
    }
    trial.found.distance = distance(*surface, trials.target, trial_samples);
    rate_elements(*surface, trials, trial);
    trial.plan.triangles.triangles = plan.triangles.triangles;
    trial.plan.flipped = plan.flipped;
    trial.plan.meant = plan.meant;
    for (const Vertex v : surface->vertices()) {
        const bool corner = v.idx() < static_cast<int>(plan.triangles.points.size());
        (corner ? trial.plan.triangles.points : trial.plan.middles).push_back(surface->point(v));
    }
    // All lengths grow so that the elements have their own size again, and the target with them.
    const double scale = plan.scale * std::cbrt(pose.linear().determinant());
    trial.plan.scale = scale;
    scale_about_origin(*surface, 1 / scale);
    for (std::size_t f = 0; f < stretch.size(); ++f) {
        trial.ratings[f].stretch = stretch[f];
        trial.ratings[f].distance /= scale;
    }
    trial.rms = trial.found.distance.rms() / scale / trials.element.la;
    trial.found.target_scale = 1 / scale;
    trial.found.surface = std::move(*surface);
    rate_bends(trials, trial);
    trial.cost = static_cast<long>(stretch.size()) * (trial.found.embedding.iterations + 20);
    return trial;
}

} // namespace rhombloom
