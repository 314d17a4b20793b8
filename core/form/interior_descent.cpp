#include <algorithm>
#include <cmath>

#include "core/form/concave_hinges.h"
#include "core/form/quasi_newton.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr int max_iterations = 60;
constexpr double largest_move = 1;      // la
constexpr double smallest_step = 0.02;  // share of the direction; below, the Hessian is nearly indefinite
constexpr double nearly_arrived = 1e-4; // gradient; below, the last factor may be good for all that is left
constexpr double arrived = 1e-5;        // gradient; below, it is known which hinges are concave
constexpr double near = 1e-3;           // gradient; below, an indefinite Hessian is not for this method
constexpr int followers = 8;            // steps with one factor
constexpr double worthwhile = 0.25;     // share of the gradient that two of them may leave

// One step of Mehrotra's predictor and corrector, if the Hessian with that damping is good for one.
bool interior_step(NewtonSystem& system, ConcaveHinges& hinges, Iterate& iterate, const EmbeddingTerms& terms,
                   double damping)
{
    HessianOptions options;
    options.damping = damping;
    options.hinges = &hinges.responses();
    if (!system.factor(iterate, options)) {
        return false;
    }
    const VectorXd residual = hinges.residual(iterate);
    hinges.direction(system, residual, Eigen::ArrayXd::Zero(terms.hinges.size()));
    const VectorXd step = hinges.direction(system, residual, hinges.corrected_target(residual.norm()));
    const double move = std::sqrt(step.reshaped(3, terms.vertex_count).colwise().squaredNorm().maxCoeff());
    const double share = std::min(hinges.longest_step(), largest_move / move);
    if (!(share > smallest_step)) {
        return false;
    }
    hinges.advance(share);
    iterate = iterate_at(terms, iterate.x + share * step);
    return std::isfinite(iterate.energy);
}

// A step with as little damping as will do; false when the iteration is stuck. An edge that is shorter than in
// equilibrium by a thousandth has lost its tension, and with it what holds its ends in place; a damped step gives it
// back.
bool damped_step(NewtonSystem& system, ConcaveHinges& hinges, Iterate& iterate, const EmbeddingTerms& terms)
{
    hinges.look(iterate.x);
    for (const double damping : {0.0, 0.1, 0.3, 1.0}) {
        if (damping > 0 && iterate.gradient_norm() < near) {
            return false;
        }
        if (interior_step(system, hinges, iterate, terms, damping)) {
            return true;
        }
    }
    return false;
}

// Quasi-Newton steps with the last factor, which is nearly that of the Hessian as soon as it is nearly known which
// hinges are concave; true when they arrive.
bool follow_up(const NewtonSystem& system, const EmbeddingTerms& terms, Iterate now, Iterate& best, double tolerance)
{
    LimitedMemory memory(followers);
    const LimitedMemory::Seed seed = [&](const VectorXd& gradient) { return system.solve(gradient); };
    double before = now.gradient_norm();
    for (int k = 1; k <= followers && now.gradient_norm() > tolerance; ++k) {
        if (!quasi_newton_step(terms, now, memory, seed)) {
            return false;
        }
        if (k % 2 == 0) {
            if (now.gradient_norm() > worthwhile * before) {
                return false;
            }
            before = now.gradient_norm();
        }
    }
    if (now.gradient_norm() > tolerance) {
        return false;
    }
    best = std::move(now);
    return true;
}

} // namespace

MinimiseResult interior_descent(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& iterate,
                                const MinimiseOptions& options)
{
    MinimiseResult result;
    if (terms.hinges.empty() || terms.hinge_law.concavity_weight <= 0 || terms.hinge_law.convex_weight >= 1) {
        return result;
    }
    Iterate now = iterate;
    ConcaveHinges hinges(terms, now.x, options.threads);
    while (now.gradient_norm() > arrived && !should_stop(now, options, result) && result.iterations < max_iterations &&
           damped_step(system, hinges, now, terms)) {
        ++result.iterations;
        if (now.energy < iterate.energy) {
            iterate = now;
        }
        if (now.gradient_norm() < nearly_arrived && follow_up(system, terms, now, iterate, options.tolerance)) {
            break;
        }
    }
    should_stop(iterate, options, result);
    return result;
}

} // namespace rhombloom
