#include "core/form/attempt.h"

#include <algorithm>

#include "core/form/local_newton.h"
#include "core/form/start_shape.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr double loaded_guards = 0.05;   // share of the energy
constexpr double same_energy = 1e-9;     // relative
constexpr double collapsed_length = 0.4; // share of the rest length
constexpr double collapsed_corner = 0.2; // sine of a corner

Attempt descend(const EmbeddingTerms& terms, const VectorXd& x, const MinimiseOptions& options)
{
    Attempt out{iterate_at(terms, x), {}};
    const auto go_on = [&](const auto& method) {
        const int before = out.result.iterations;
        out.result = method(terms, out.iterate, options);
        out.result.iterations += before;
    };
    go_on(local_newton);
    if (out.result.reason == StopReason::Stalled) {
        go_on(minimise);
    }
    return out;
}

} // namespace

Attempt attempt(const EmbeddingTerms& terms, const VectorXd& x, const MinimiseOptions& options)
{
    Attempt out = descend(terms, x, options);
    VectorXd inverted = out.iterate.x;
    mirror(inverted);
    if (out.result.reason == StopReason::Cancelled ||
        embedding_energy(terms, inverted).total() >= 0.9 * out.iterate.energy) {
        return out;
    }
    Attempt turned = descend(terms, inverted, options);
    turned.result.iterations += out.result.iterations;
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

bool is_better(const Attempt& a, const Attempt& b)
{
    const bool a_converged = a.result.reason == StopReason::Converged;
    const bool b_converged = b.result.reason == StopReason::Converged;
    return a_converged != b_converged ? a_converged
                                      : a.iterate.energy < b.iterate.energy - same_energy * std::abs(b.iterate.energy);
}

bool is_good(const EmbeddingTerms& terms, const Attempt& attempt)
{
    return attempt.result.reason == StopReason::Converged &&
           sharpest_concavity(terms, attempt.iterate.x) > dimple_angle &&
           embedding_energy(terms, attempt.iterate.x).guard <= loaded_guards * attempt.iterate.energy;
}

bool keep_better(Attempt& best, Attempt other)
{
    const int iterations = best.result.iterations + other.result.iterations;
    const bool better = is_better(other, best);
    if (better) {
        best = std::move(other);
    }
    best.result.iterations = iterations;
    return better;
}

} // namespace rhombloom
