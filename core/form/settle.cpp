#include "core/form/settle.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "core/form/attempt.h"
#include "core/form/connectivity_start.h"
#include "core/form/local_newton.h"
#include "core/form/lower_equilibrium.h"
#include "core/form/nearby_newton.h"
#include "core/form/start_shape.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr double wild_energy = 20;        // la per spring pair on average: positions that know nothing of the shape
constexpr int small_surface = 300;        // vertices; the layouts of such a one take about a second
constexpr double crease = -0.02;          // radians; a closed surface without one has but one equilibrium
constexpr double changed_imbalance = 2;   // gradient, where an equilibrium was changed a little
constexpr double rounded_imbalance = .05; // where its positions were rounded
constexpr double flattening = 1e-2;       // convex weight that unfolds a shape

// The given positions, made usable; nothing is changed on those that are.
VectorXd usable(const EmbeddingTerms& terms, VectorXd x)
{
    const int dimensions = spread_dimensions(x);
    if (dimensions < 2) {
        x = spectral_layout(terms);
    }
    VectorXd scaled = x;
    rescale(terms, scaled);
    if (scaled.norm() > 3 * x.norm() || 3 * scaled.norm() < x.norm()) {
        x = scaled;
    }
    if (dimensions == 2) {
        bulge(terms, x);
    }
    separate(terms, x);
    VectorXd inverted = x;
    mirror(inverted);
    return embedding_energy(terms, inverted).total() < 0.5 * embedding_energy(terms, x).total() ? inverted : x;
}

bool is_wild(const EmbeddingTerms& terms, const VectorXd& x)
{
    return embedding_energy(terms, x).total() > wild_energy * double(terms.springs.size());
}

// The equilibrium with a small stiffness of convex hinges, as a start: it has no folds.
VectorXd unfolded(const EmbeddingTerms& terms, const VectorXd& x, const MinimiseOptions& options)
{
    EmbeddingTerms stiff = terms;
    stiff.hinge_law.convex_weight = std::max(flattening, terms.hinge_law.convex_weight);
    Iterate iterate = iterate_at(stiff, x);
    minimise(stiff, iterate, options);
    return iterate.x;
}

constexpr int first_repairs = 5;   // then layouts
constexpr int few_iterations = 25; // for the guards to go after an edit

// As many layouts as take about a tenth of a second.
int layouts(const EmbeddingTerms& terms)
{
    return static_cast<int>(std::min(8.0, 2e5 / (double(terms.vertex_count) * terms.vertex_count)));
}

// The k-th repair, of the positions at the start or of the best result so far; false when it does not apply.
bool repair(const EmbeddingTerms& terms, const VectorXd& start, const VectorXd& best, int k,
            const MinimiseOptions& options, VectorXd& x)
{
    x = k == 0 || k == 3 ? best : start;
    switch (k) {
    case 0:
        return pop_dimples(terms, x);
    case 1:
        x = unfolded(terms, x, options);
        return true;
    case 2:
        smooth(terms, x, 6);
        break;
    case 3:
        smooth(terms, x, 12);
        break;
    case 4:
        x = unfolded(terms, usable(terms, spectral_layout(terms)), options);
        return true;
    default:
        x = distance_layout(terms, k - first_repairs);
        return true;
    }
    x = usable(terms, x);
    return true;
}

// Where a guard bears load, look for an equilibrium of the energy without it: first among the vertices near it, so that
// elements that collapse do so at little cost.
bool stands_without_guards(EmbeddingTerms& terms, Attempt& state, const MinimiseOptions& options)
{
    EmbeddingTerms pure = terms;
    remove_guards(pure);
    Attempt without{iterate_at(pure, state.iterate.x), {}};
    without.result = local_newton(pure, without.iterate, options);
    state.result.iterations += without.result.iterations;
    if (without.result.reason == StopReason::Stalled && !has_collapsed(pure, without.iterate.x)) {
        without.result = newton(pure, without.iterate, options);
        state.result.iterations += without.result.iterations;
    }
    if (without.result.reason != StopReason::Converged || has_collapsed(pure, without.iterate.x)) {
        return false;
    }
    state.iterate = without.iterate;
    terms = std::move(pure);
    return true;
}

bool bears_load(const EmbeddingTerms& terms, const Attempt& state)
{
    return embedding_energy(terms, state.iterate.x).guard > 0;
}

// Does the shape need a guard to be in equilibrium? If not, there is none when this returns.
bool needs_guards(EmbeddingTerms& terms, Attempt& state, const MinimiseOptions& options)
{
    return bears_load(terms, state) &&
           (state.result.reason != StopReason::Converged || !stands_without_guards(terms, state, options));
}

bool has_boundary(const EmbeddingTerms& terms)
{
    return std::any_of(terms.springs.begin(), terms.springs.begin() + terms.edge_count,
                       [](const SpringPair& pair) { return pair.count == 1; });
}

// A sheet bends along one diagonal or the other, to either side, and one way so far that it folds. The unfolded sheet
// and its mirror image bend different ways.
bool unroll(const EmbeddingTerms& terms, Attempt& best, const MinimiseOptions& options)
{
    VectorXd x = unfolded(terms, best.iterate.x, options);
    for (int side = 0; side < 2; ++side) {
        Attempt other = attempt(terms, x, options);
        best.result.iterations += other.result.iterations;
        if (is_good(terms, other) && embedding_energy(terms, other.iterate.x).guard == 0) {
            other.result.iterations = best.result.iterations;
            best = std::move(other);
            return true;
        }
        mirror(x);
    }
    return false;
}

// The given positions, smoothed when they are wild.
VectorXd first_try(const EmbeddingTerms& terms, const VectorXd& x)
{
    VectorXd first = usable(terms, x);
    if (is_wild(terms, first)) {
        smooth(terms, first, 3);
        first = usable(terms, first);
    }
    return first;
}

// From the positions, as far as they know anything, and from the connectivity alone: where they know nothing, where
// that costs little and there may be others, and where they lead to a fold.
Attempt attempt_disordered(const EmbeddingTerms& terms, const VectorXd& x, const VectorXd& first,
                           const MinimiseOptions& options)
{
    if (has_layouts(terms) && knows_nothing(terms, x)) {
        return attempt_from_connectivity(terms, options);
    }
    Attempt best = attempt(terms, first, options);
    refill_folds(terms, best, options);
    const bool creased = is_wild(terms, x) && sharpest_concavity(terms, best.iterate.x) < crease;
    const bool doubtful = terms.vertex_count <= small_surface && (has_boundary(terms) || creased);
    if (best.result.reason != StopReason::Cancelled && has_layouts(terms) && (doubtful || !is_good(terms, best))) {
        keep_better(best, attempt_from_connectivity(terms, options));
    }
    return best;
}

// One repair after the other until the best is good; how many. From disorder it is not good while a guard bears load.
int try_repairs(const EmbeddingTerms& terms, const VectorXd& first, bool disordered, Attempt& best,
                const MinimiseOptions& options)
{
    const auto is_done = [&] {
        return best.result.reason == StopReason::Cancelled ||
               (is_good(terms, best) && !(disordered && embedding_energy(terms, best.iterate.x).guard > 0));
    };
    int restarts = 0;
    bool cancelled = false;
    for (int k = 0; k < first_repairs + layouts(terms) && !cancelled && !is_done(); ++k) {
        VectorXd repaired;
        if (!repair(terms, first, best.iterate.x, k, options, repaired)) {
            continue;
        }
        ++restarts;
        Attempt next = attempt(terms, repaired, options);
        cancelled = next.result.reason == StopReason::Cancelled;
        keep_better(best, std::move(next));
    }
    return restarts;
}

// Out of equilibrium by how much at most, for Newton's method to look nearby: an edited shape was in equilibrium, other
// positions may be close to one that is no good.
double most_imbalance(const EmbeddingTerms& terms, const MinimiseOptions& options, Start start)
{
    return start != Start::Edited ? options.tolerance : is_large(terms) ? rounded_imbalance : changed_imbalance;
}

// From positions close to an equilibrium of nothing but the energy of the paper, there. The guards would push a sharp
// fold away from it, perhaps for good.
std::optional<Settled> settle_nearby(EmbeddingTerms& terms, VectorXd& x, const MinimiseOptions& options, Start start)
{
    EmbeddingTerms pure = terms;
    remove_guards(pure);
    const Iterate begin = iterate_at(pure, x);
    if (begin.gradient_norm() > most_imbalance(terms, options, start) || has_collapsed(pure, x)) {
        return std::nullopt;
    }
    Attempt candidate{begin, {}};
    candidate.result = local_newton(pure, candidate.iterate, options);
    if (candidate.result.reason == StopReason::Stalled) {
        candidate.iterate = begin;
        candidate.result = nearby_newton(pure, candidate.iterate, options);
    }
    if (candidate.result.reason == StopReason::Stalled || has_collapsed(pure, candidate.iterate.x)) {
        return std::nullopt;
    }
    terms = std::move(pure);
    x = std::move(candidate.iterate.x);
    return Settled{candidate.result, 0, false};
}

} // namespace

void remove_guards(EmbeddingTerms& terms)
{
    terms.spring_law.barrier_weight = 0;
    terms.hinge_law.ridge_height = 0;
}

Settled settle(EmbeddingTerms& terms, VectorXd& x, const MinimiseOptions& options, Start start, bool keep_guards)
{
    if (auto settled = settle_nearby(terms, x, options, start)) {
        return *settled;
    }
    const VectorXd first = first_try(terms, x);
    const bool disordered = start == Start::Unknown && is_disordered(terms, x);
    Settled settled;
    Attempt best = disordered ? attempt_disordered(terms, x, first, options) : attempt(terms, first, options);
    settled.restarts = start == Start::Unknown ? try_repairs(terms, first, disordered, best, options) : 0;
    MinimiseOptions rest = options;
    rest.max_iterations = start == Start::Edited ? few_iterations : options.max_iterations;
    settled.guarded = keep_guards ? bears_load(terms, best) : needs_guards(terms, best, rest);
    if (disordered) {
        lower_equilibrium(terms, best, options);
        settled.guarded = settled.guarded && needs_guards(terms, best, rest);
    }
    if (settled.guarded && start == Start::Unknown && has_boundary(terms) &&
        best.result.reason == StopReason::Converged) {
        settled.guarded = !unroll(terms, best, options);
        settled.restarts += 1;
    }
    settled.result = best.result;
    x = best.iterate.x;
    return settled;
}

} // namespace rhombloom
