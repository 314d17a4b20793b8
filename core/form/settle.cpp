#include "core/form/settle.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "core/form/local_newton.h"
#include "core/form/nearby_newton.h"
#include "core/form/start_shape.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr double wild_energy = 20;        // la per spring pair on average: positions that know nothing of the shape
constexpr double dimple = -0.785;         // radians
constexpr double loaded_guards = 0.05;    // share of the energy
constexpr double flattening = 1e-2;       // convex weight that unfolds a shape
constexpr double same_energy = 1e-9;      // relative
constexpr double collapsed_length = 0.4;  // share of the rest length
constexpr double collapsed_corner = 0.2;  // sine of a corner
constexpr double changed_imbalance = 2;   // gradient, where an equilibrium was changed a little
constexpr double rounded_imbalance = .05; // where its positions were rounded

struct Candidate
{
    Iterate iterate;
    MinimiseResult result;
};

bool is_better(const Candidate& a, const Candidate& b)
{
    const bool a_converged = a.result.reason == StopReason::Converged;
    const bool b_converged = b.result.reason == StopReason::Converged;
    return a_converged != b_converged ? a_converged
                                      : a.iterate.energy < b.iterate.energy - same_energy * std::abs(b.iterate.energy);
}

bool is_good(const EmbeddingTerms& terms, const Candidate& candidate)
{
    return candidate.result.reason == StopReason::Converged &&
           sharpest_concavity(terms, candidate.iterate.x) > dimple &&
           embedding_energy(terms, candidate.iterate.x).guard <= loaded_guards * candidate.iterate.energy;
}

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

Candidate descend(const EmbeddingTerms& terms, const VectorXd& x, const MinimiseOptions& options)
{
    Candidate candidate{iterate_at(terms, x), {}};
    const auto go_on = [&](const auto& method) {
        const int before = candidate.result.iterations;
        candidate.result = method(terms, candidate.iterate, options);
        candidate.result.iterations += before;
    };
    go_on(local_newton);
    if (candidate.result.reason == StopReason::Stalled) {
        go_on(minimise);
    }
    return candidate;
}

// A surface that has settled inside out turns over.
Candidate attempt(const EmbeddingTerms& terms, const VectorXd& x, const MinimiseOptions& options)
{
    Candidate candidate = descend(terms, x, options);
    VectorXd inverted = candidate.iterate.x;
    mirror(inverted);
    if (candidate.result.reason == StopReason::Cancelled ||
        embedding_energy(terms, inverted).total() >= 0.9 * candidate.iterate.energy) {
        return candidate;
    }
    Candidate turned = descend(terms, inverted, options);
    turned.result.iterations += candidate.result.iterations;
    return turned;
}

bool has_collapsed(const EmbeddingTerms& terms, const VectorXd& x)
{
    const auto at = [&](int v) { return Eigen::Vector3d(x.segment<3>(3 * v)); };
    const bool short_spring = std::any_of(terms.springs.begin(), terms.springs.end(), [&](const SpringPair& pair) {
        return (at(pair.b) - at(pair.a)).norm() < collapsed_length * std::max(pair.rest[0], pair.rest[1]);
    });
    const auto is_thin = [&](const Eigen::Vector3d& edge, const Eigen::Vector3d& side) {
        return edge.cross(side).norm() < collapsed_corner * edge.norm() * side.norm();
    };
    return short_spring || std::any_of(terms.hinges.begin(), terms.hinges.end(), [&](const HingeVertices& h) {
               const Eigen::Vector3d edge = at(h[1]) - at(h[0]);
               return is_thin(edge, at(h[2]) - at(h[0])) || is_thin(edge, at(h[3]) - at(h[0]));
           });
}

// Where a guard bears load, look for an equilibrium of the energy without it: first among the vertices near it, so that
// elements that collapse do so at little cost.
bool stands_without_guards(EmbeddingTerms& terms, Candidate& candidate, const MinimiseOptions& options)
{
    EmbeddingTerms pure = terms;
    remove_guards(pure);
    Candidate without{iterate_at(pure, candidate.iterate.x), {}};
    without.result = local_newton(pure, without.iterate, options);
    candidate.result.iterations += without.result.iterations;
    if (without.result.reason == StopReason::Stalled && !has_collapsed(pure, without.iterate.x)) {
        without.result = newton(pure, without.iterate, options);
        candidate.result.iterations += without.result.iterations;
    }
    if (without.result.reason != StopReason::Converged || has_collapsed(pure, without.iterate.x)) {
        return false;
    }
    candidate.iterate = without.iterate;
    terms = std::move(pure);
    return true;
}

// Does the shape need a guard to be in equilibrium? If not, there is none when this returns.
bool needs_guards(EmbeddingTerms& terms, Candidate& candidate, const MinimiseOptions& options)
{
    return embedding_energy(terms, candidate.iterate.x).guard > 0 &&
           (candidate.result.reason != StopReason::Converged || !stands_without_guards(terms, candidate, options));
}

bool has_boundary(const EmbeddingTerms& terms)
{
    return std::any_of(terms.springs.begin(), terms.springs.begin() + terms.edge_count,
                       [](const SpringPair& pair) { return pair.count == 1; });
}

// A sheet bends along one diagonal or the other, to either side, and one way so far that it folds. The unfolded sheet
// and its mirror image bend different ways.
bool unroll(const EmbeddingTerms& terms, Candidate& best, const MinimiseOptions& options)
{
    VectorXd x = unfolded(terms, best.iterate.x, options);
    for (int side = 0; side < 2; ++side) {
        Candidate other = attempt(terms, x, options);
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
    Candidate candidate{begin, {}};
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

Settled settle(EmbeddingTerms& terms, VectorXd& x, const MinimiseOptions& options, Start start)
{
    if (auto settled = settle_nearby(terms, x, options, start)) {
        return *settled;
    }
    VectorXd first = usable(terms, x);
    if (is_wild(terms, first)) {
        smooth(terms, first, 3);
        first = usable(terms, first);
    }
    const int repairs = start == Start::Edited ? 0 : first_repairs + layouts(terms);
    Settled settled;
    Candidate best = attempt(terms, first, options);
    int iterations = best.result.iterations;
    for (int k = 0; k < repairs && best.result.reason != StopReason::Cancelled && !is_good(terms, best); ++k) {
        VectorXd repaired;
        if (!repair(terms, first, best.iterate.x, k, options, repaired)) {
            continue;
        }
        ++settled.restarts;
        Candidate next = attempt(terms, repaired, options);
        iterations += next.result.iterations;
        const bool cancelled = next.result.reason == StopReason::Cancelled;
        if (is_better(next, best)) {
            best = std::move(next);
        }
        if (cancelled) {
            break;
        }
    }
    best.result.iterations = iterations;
    MinimiseOptions rest = options;
    rest.max_iterations = start == Start::Edited ? few_iterations : options.max_iterations;
    settled.guarded = needs_guards(terms, best, rest);
    if (settled.guarded && repairs > 0 && has_boundary(terms) && best.result.reason == StopReason::Converged) {
        settled.guarded = !unroll(terms, best, options);
        settled.restarts += 1;
    }
    settled.result = best.result;
    x = best.iterate.x;
    return settled;
}

} // namespace rhombloom
