#include <algorithm>
#include <cmath>
#include <limits>

#include "core/form/concave_hinges.h"
#include "core/form/quasi_newton.h"
#include "core/form/smoothed_descent.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr int max_iterations = 200;
constexpr double largest_move = 1;      // la
constexpr double smallest_step = 0.02;  // share of the direction; below, the Hessian is nearly indefinite
constexpr double smallest_near = 0.3;   // the same near equilibrium
constexpr double near = 0.05;           // of the first residual
constexpr double path_width = 0.04;     // of the mean angle: where near a first equilibrium the path begins
constexpr double least_width = 1e-8;    // of the mean angle
constexpr double narrower = 0.5;        // of the width from which the last steps did not lead on
constexpr double nearly_arrived = 1e-4; // gradient; below, the last factor may be good for all that is left
constexpr double arrived = 1e-7;        // gradient; below, it is known which hinges are concave
constexpr int followers = 8;            // steps with one factor
constexpr double worthwhile = 0.25;     // share of the gradient that two of them may leave

// Along the central path, and back to it.
class Descent
{
public:
    Descent(const EmbeddingTerms& terms, NewtonSystem& system, const Iterate& start, const MinimiseOptions& options)
        : terms_(terms), system_(system), options_(options), hinges_(terms, start.x, options.threads), now_(start)
    {
    }

    const Iterate& now() const { return now_; }
    double mean_angle() const { return hinges_.mean_angle(); }

    // False when the iteration is stuck, or it is time to stop.
    bool step(MinimiseResult& result)
    {
        hinges_.look(now_.x);
        const double residual = hinges_.residual(now_).norm();
        first_residual_ = std::max(first_residual_, residual);
        if (on_path_ || residual < near * first_residual_) {
            return interior_step(0, smallest_near, result) ||
                   return_to_path(std::min(hinges_.width(), narrower * last_width_), result);
        }
        return damped_step(result);
    }

    // To the path's point with that width: off the path the Hessian can be indefinite where it is not on it; and if it
    // becomes so on the path, the surface loses a symmetry there, for which that point has to be a minimum.
    bool return_to_path(double width, MinimiseResult& result)
    {
        if (width < least_width * mean_angle() || !smoothed_descent(terms_, system_, now_, width, options_, result)) {
            return false;
        }
        hinges_.put_on_path(now_.x, width);
        last_width_ = width;
        on_path_ = true;
        return true;
    }

private:
    // One step of Mehrotra's predictor and corrector, if the Hessian with that damping is good for one.
    bool interior_step(double damping, double least_share, MinimiseResult& result)
    {
        HessianOptions options;
        options.damping = damping;
        options.hinges = &hinges_.responses();
        if (!system_.factor(now_, options)) {
            return false;
        }
        const VectorXd residual = hinges_.residual(now_);
        hinges_.direction(system_, residual, Eigen::ArrayXd::Zero(terms_.hinges.size()));
        const VectorXd step = hinges_.direction(system_, residual, hinges_.corrected_target(residual.norm()));
        const double move = std::sqrt(step.reshaped(3, terms_.vertex_count).colwise().squaredNorm().maxCoeff());
        const double share = std::min(hinges_.longest_step(), largest_move / move);
        if (!(share > least_share)) {
            return false;
        }
        hinges_.advance(share);
        now_ = iterate_at(terms_, now_.x + share * step);
        ++result.iterations;
        return std::isfinite(now_.energy);
    }

    // A step with as little damping as will do. An edge that is shorter than in equilibrium by a thousandth has lost
    // its tension, and with it what holds its ends in place; a damped step gives it back.
    bool damped_step(MinimiseResult& result)
    {
        for (const double damping : {0.0, 0.1, 0.3, 1.0}) {
            if (interior_step(damping, smallest_step, result)) {
                return true;
            }
        }
        return false;
    }

    const EmbeddingTerms& terms_;
    NewtonSystem& system_;
    const MinimiseOptions& options_;
    ConcaveHinges hinges_;
    Iterate now_;
    double first_residual_ = 0;
    double last_width_ = std::numeric_limits<double>::infinity();
    bool on_path_ = false;
};

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

// Of two iterates with the same energy, but for roundoff, the one with the smaller gradient is better.
bool is_better(const Iterate& a, const Iterate& b)
{
    constexpr double roundoff = 1e-12; // relative
    const double difference = a.energy - b.energy;
    const double noise = roundoff * std::abs(b.energy);
    return difference < -noise || (difference < noise && a.gradient_norm() < b.gradient_norm());
}

// Steps until nothing is left to settle; the best iterate goes to \p iterate.
void follow(Descent& descent, const NewtonSystem& system, const EmbeddingTerms& terms, Iterate& iterate,
            const MinimiseOptions& options, MinimiseResult& result)
{
    const auto keep = [&] {
        if (is_better(descent.now(), iterate)) {
            iterate = descent.now();
        }
    };
    while (descent.now().gradient_norm() > arrived && !should_stop(descent.now(), options, result) &&
           result.iterations < max_iterations && descent.step(result)) {
        keep();
        if (descent.now().gradient_norm() < nearly_arrived &&
            follow_up(system, terms, descent.now(), iterate, options.tolerance)) {
            break;
        }
    }
    keep(); // of what did not come to an end
    if (result.reason == StopReason::Converged) {
        result.reason = StopReason::Stalled; // unless the best one has
    }
    should_stop(iterate, options, result);
}

bool has_concave_hinges(const EmbeddingTerms& terms)
{
    return !terms.hinges.empty() && terms.hinge_law.concavity_weight > 0 && terms.hinge_law.convex_weight < 1;
}

} // namespace

MinimiseResult interior_descent(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& iterate,
                                const MinimiseOptions& options)
{
    MinimiseResult result;
    if (has_concave_hinges(terms)) {
        Descent descent(terms, system, iterate, options);
        follow(descent, system, terms, iterate, options, result);
    }
    return result;
}

MinimiseResult interior_descent_near(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& iterate,
                                     const MinimiseOptions& options, double share)
{
    MinimiseResult result;
    if (has_concave_hinges(terms)) {
        Descent descent(terms, system, iterate, options);
        if (descent.return_to_path(share * path_width * descent.mean_angle(), result)) {
            follow(descent, system, terms, iterate, options, result);
        }
    }
    return result;
}

} // namespace rhombloom
