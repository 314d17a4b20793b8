#include <algorithm>
#include <cmath>

#include "core/form/minimise.h"
#include "core/form/newton_system.h"

namespace rhombloom {

namespace {

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
    while (!stagnation.lasts(iterate) && line_search(terms, iterate, system.direction(iterate), {1, 2})) {
        ++result.iterations;
        if (should_stop(iterate, options, result)) {
            return result;
        }
    }
    result.reason = StopReason::Stalled;
    return result;
}

} // namespace rhombloom
