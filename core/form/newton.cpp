#include <algorithm>
#include <cmath>

#include "core/form/newton_system.h"
#include "core/form/quasi_newton.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

// A step cut short has run into hinges that become concave. Before the next factorisation, steps with the old one.
constexpr double shortened = 0.5;
constexpr int followers = 8;

// Notices that neither the energy nor the gradient gets anywhere.
class Stagnation
{
public:
    explicit Stagnation(const Iterate& iterate) : energy_(iterate.energy), gradient_(iterate.gradient_norm()) {}

    bool lasts(const Iterate& iterate)
    {
        if (++iterations_ % period != 0) {
            return false;
        }
        const bool idle =
            iterate.energy > energy_ - 1e-7 * std::abs(energy_) && iterate.gradient_norm() > gradient_ / 4;
        energy_ = iterate.energy;
        gradient_ = std::min(gradient_, iterate.gradient_norm());
        return idle;
    }

private:
    static constexpr int period = 40;
    int iterations_ = 0;
    double energy_;
    double gradient_;
};

// Quasi-Newton steps with the factor at hand, after the last step and by its memory.
void follow_up(const EmbeddingTerms& terms, const NewtonSystem& system, const Iterate& last, Iterate& iterate,
               const MinimiseOptions& options)
{
    LimitedMemory memory(followers);
    memory.remember(iterate.x - last.x, iterate.gradient - last.gradient);
    const LimitedMemory::Seed seed = [&](const Eigen::VectorXd& gradient) { return system.solve(gradient); };
    for (int k = 0; k < followers && iterate.gradient_norm() > options.tolerance; ++k) {
        if (!quasi_newton_step(terms, iterate, memory, seed)) {
            return;
        }
    }
}

} // namespace

MinimiseResult newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options)
{
    MinimiseResult result;
    if (!should_stop(iterate, options, result)) {
        NewtonSystem system(terms, options.threads);
        result = newton_with(system, terms, iterate, options);
    }
    return result;
}

MinimiseResult newton_with(NewtonSystem& system, const EmbeddingTerms& terms, Iterate& iterate,
                           const MinimiseOptions& options)
{
    MinimiseResult result;
    Stagnation stagnation(iterate);
    double share = 1;
    while (!stagnation.lasts(iterate)) {
        const bool exact = is_large(terms) && system.factor(iterate, {});
        if (is_large(terms) && !exact) {
            const int before = result.iterations;
            result = interior_descent_near(terms, system, iterate, rest_of(options, before), share);
            result.iterations += before;
            share /= 4;
            if (result.reason != StopReason::Stalled || result.iterations == before) {
                return result;
            }
            continue;
        }
        const Iterate last = iterate;
        const VectorXd direction = exact ? VectorXd(-system.solve(iterate.gradient)) : system.direction(iterate);
        const double step = line_search(terms, iterate, direction, {1, 2});
        if (step == 0) {
            break;
        }
        if (step < shortened && is_large(terms)) {
            follow_up(terms, system, last, iterate, options);
        }
        ++result.iterations;
        if (should_stop(iterate, options, result)) {
            return result;
        }
    }
    result.reason = StopReason::Stalled;
    return result;
}

} // namespace rhombloom
