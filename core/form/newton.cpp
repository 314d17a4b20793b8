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

// How hinges enter a Hessian that need not know which of them are concave: stiff by a share that falls from 1 to 0
// where the angle goes from minus to plus a few widths.
std::vector<HingeResponse> softened(const EmbeddingTerms& terms, const VectorXd& x, double width)
{
    std::vector<HingeResponse> out;
    out.reserve(terms.hinges.size());
    for (const HingeVertices& hinge : terms.hinges) {
        const double angle = hinge_angle(hinge_points(x, hinge));
        const double share = (1 - angle / std::sqrt(angle * angle + 4 * width * width)) / 2;
        out.push_back(shared_response(terms.hinge_law, angle, share));
    }
    return out;
}

double mean_angle(const EmbeddingTerms& terms, const VectorXd& x)
{
    double sum = 0;
    for (const HingeVertices& hinge : terms.hinges) {
        sum += std::abs(hinge_angle(hinge_points(x, hinge)));
    }
    return sum / double(terms.hinges.size());
}

// Quasi-Newton steps with one factorisation, for where the Hessian is indefinite because of hinges that are flat but
// for a little and free at the moment. Softened, they hold; and as long as they do, the factor is good for many steps.
class SoftenedSteps
{
public:
    // Factor, as little softened as will do; false when nothing will.
    bool begin(NewtonSystem& system, const EmbeddingTerms& terms, const Iterate& iterate)
    {
        const double mean = mean_angle(terms, iterate.x);
        width_ = width_ == 0 ? first_width * mean : std::max(narrower * width_, least_width * mean);
        for (int attempt = 0; attempt < attempts; ++attempt, width_ *= 2) {
            const std::vector<HingeResponse> hinges = softened(terms, iterate.x, width_);
            if (system.factor(iterate, {0, &hinges})) {
                memory_.clear();
                left_ = steps;
                return true;
            }
        }
        return false;
    }

    // One step; false when another factorisation is due.
    bool step(const NewtonSystem& system, const EmbeddingTerms& terms, Iterate& iterate)
    {
        return left_-- > 0 && quasi_newton_step(terms, iterate, memory_,
                                                [&](const VectorXd& gradient) { return system.solve(gradient); });
    }

private:
    static constexpr double first_width = 0.3; // of the mean angle
    static constexpr double least_width = 0.07;
    static constexpr double narrower = 0.7;
    static constexpr int attempts = 6;
    static constexpr int steps = 30;
    LimitedMemory memory_{20};
    double width_ = 0;
    int left_ = 0;
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
    SoftenedSteps softened_steps;
    while (!stagnation.lasts(iterate)) {
        const bool exact = is_large(terms) && system.factor(iterate, {});
        if (is_large(terms) && !exact && softened_steps.begin(system, terms, iterate)) {
            while (softened_steps.step(system, terms, iterate)) {
                ++result.iterations;
                if (should_stop(iterate, options, result)) {
                    return result;
                }
            }
            continue;
        }
        const Iterate last = iterate;
        const VectorXd direction = exact ? VectorXd(-system.solve(iterate.gradient)) : system.direction(iterate);
        const double share = line_search(terms, iterate, direction, {1, 2});
        if (share == 0) {
            break;
        }
        if (share < shortened && is_large(terms)) {
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
