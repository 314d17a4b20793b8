#include "core/form/minimise.h"

namespace rhombloom {

bool should_stop(const Iterate& iterate, const MinimiseOptions& options, MinimiseResult& result)
{
    if (iterate.gradient_norm() <= options.tolerance) {
        result.reason = StopReason::Converged;
    } else if (options.progress && !options.progress(result.iterations, iterate)) {
        result.reason = StopReason::Cancelled;
    } else if (result.iterations >= options.max_iterations) {
        result.reason = StopReason::IterationLimit;
    } else {
        return false;
    }
    return true;
}

MinimiseResult minimise(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options)
{
    const MinimiseResult first = quasi_newton(terms, iterate, options);
    if (first.reason != StopReason::Stalled) {
        return first;
    }
    MinimiseOptions rest = options;
    rest.max_iterations -= first.iterations;
    if (options.progress) {
        rest.progress = [&](int iteration, const Iterate& now) {
            return options.progress(first.iterations + iteration, now);
        };
    }
    MinimiseResult second = newton(terms, iterate, rest);
    second.iterations += first.iterations;
    return second;
}

} // namespace rhombloom
