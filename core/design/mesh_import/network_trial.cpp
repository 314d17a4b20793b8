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

void scale_about_origin(Surface& surface, double factor)
{
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, factor * surface.point(v));
    }
}

void move(Surface& surface, const Eigen::Affine3d& pose)
{
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, pose * surface.point(v));
    }
}

void rate_stretch(const Surface& surface, const Element& element, Trial& trial)
{
    trial.ratings.resize(surface.n_faces());
    for (const Face f : surface.faces()) {
        const double stretch = element_stretch(surface, element, f);
        trial.ratings[f.idx()].stretch = stretch;
        trial.excess += excess_stretch(stretch);
    }
}

void find_middles(const Surface& surface, Trial& trial)
{
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        Vec3 sum = Vec3::Zero();
        for (const int v : q) {
            sum += surface.point(Vertex(v));
        }
        trial.ratings[f.idx()].middle = sum / 4;
    }
}

//! After the trial's plan.
void rate_bends(const Surface& surface, Trial& trial)
{
    const std::vector<Eigen::Matrix3d> turned = turns(trial.plan.triangles, trial.plan.meant);
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        trial.ratings[f.idx()].bend = (turned[q[0]] - turned[q[2]]).squaredNorm();
    }
}

//! The points of the plan are where those of its surface are.
void take_points(const Surface& surface, Plan& plan)
{
    for (const Vertex v : surface.vertices()) {
        const std::size_t k = v.idx();
        const std::size_t corners = plan.triangles.points.size();
        (k < corners ? plan.triangles.points[k] : plan.middles[k - corners]) = surface.point(v);
    }
}

EmbedReport embed_quickly(Surface& surface, const Trials& trials, Aim aim)
{
    EmbedOptions quick = trials.options.embedding;
    quick.tolerance = 1e-5;      // a trial need not be exact
    quick.start = Start::Edited; // the target's creases are meant
    quick.max_iterations = trials.max_iterations;
    quick.max_newton_iterations = trials.max_newton_iterations;
    quick.keep_guards = aim == Aim::Straight; // in folds; they bend no limb, to be rid of them takes half the time
    quick.threads = 1;                        // several trials run side by side
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

std::optional<Trial> settle(const Plan& plan, const Trials& trials, Aim aim)
{
    auto surface = surface_of(plan);
    if (!surface || !has_permissible_defects(*surface, trials.element)) {
        return std::nullopt;
    }
    Trial trial;
    scale_about_origin(*surface, 1 / plan.scale); // so what was in equilibrium still is
    trial.found.embedding = embed_quickly(*surface, trials, aim);
    if (!trial.found.embedding.converged) {
        return std::nullopt;
    }
    rate_stretch(*surface, trials.element, trial);
    scale_about_origin(*surface, plan.scale);
    trial.plan = plan;
    take_points(*surface, trial.plan);
    const bool rescale = trials.options.rescale;
    const Fit fitted = aim == Aim::Near ? fit(*surface, trials.target, rescale)
                                        : Fit{astray(trial.plan.triangles.points, plan.meant, rescale).pose, {}};
    move(*surface, fitted.pose);
    take_points(*surface, trial.plan);
    find_middles(*surface, trial);
    // All lengths grow so that the elements have their own size again, and the target with them.
    const double scale = plan.scale * std::cbrt(fitted.pose.linear().determinant());
    const double la = scale * trials.element.la; // of the elements on the target as it was searched
    if (aim == Aim::Near) {
        for (ElementRating& rating : trial.ratings) {
            rating.distance = trials.target.nearest(rating.middle).distance / la;
        }
    } else {
        rate_bends(*surface, trial);
    }
    if (!plan.meant.empty()) {
        trial.astray = astray(trial.plan.triangles.points, plan.meant, rescale).rms / la;
    }
    trial.rms = fitted.distance.rms() / la;
    trial.plan.scale = scale;
    scale_about_origin(*surface, 1 / scale);
    trial.found.distance = fitted.distance;
    trial.found.target_scale = 1 / scale;
    trial.found.surface = std::move(*surface);
    trial.cost = static_cast<long>(trial.ratings.size()) * (trial.found.embedding.iterations + 20);
    return trial;
}

} // namespace rhombloom
