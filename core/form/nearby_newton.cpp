#include "core/form/nearby_newton.h"

#include "core/form/newton_system.h"

namespace rhombloom {

namespace {

constexpr int most_iterations = 100;
constexpr double longest_move = 0.1; // la, of a vertex in one step

} // namespace

MinimiseResult nearby_newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options)
{
    MinimiseResult result;
    if (should_stop(iterate, options, result)) {
        return result;
    }
    NewtonSystem system(terms, options.threads);
    while (result.iterations < most_iterations &&
           line_search(terms, iterate, system.direction(iterate), {1, longest_move}) > 0) {
        ++result.iterations;
        if (should_stop(iterate, options, result)) {
            return result;
        }
    }
    result.reason = StopReason::Stalled;
    return result;
}

} // namespace rhombloom
