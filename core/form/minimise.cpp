#include "core/form/minimise.h"

#include "core/form/newton_system.h"

namespace rhombloom {

MinimiseOptions rest_of(const MinimiseOptions& options, int done)
{
    MinimiseOptions rest = options;
    rest.max_iterations -= done;
    if (options.progress) {
        rest.progress = [&options, done](int iteration, const Iterate& now) {
            return options.progress(done + iteration, now);
        };
    }
    return rest;
}

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

bool is_large(const EmbeddingTerms& terms)
{
    return terms.vertex_count >= 3000;
}

MinimiseResult minimise(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options)
{
    MinimiseResult result = quasi_newton(terms, iterate, options);
    const auto go_on = [&](auto&& method) {
        if (result.reason == StopReason::Stalled) {
            const int before = result.iterations;
            result = method(rest_of(options, before));
            result.iterations += before;
        }
    };
    if (result.reason != StopReason::Stalled) {
        return result;
    }
    NewtonSystem system(terms, options.threads);
    if (is_large(terms)) {
        go_on([&](const MinimiseOptions& rest) { return interior_descent(terms, system, iterate, rest); });
    }
    go_on([&](const MinimiseOptions& rest) { return newton_with(system, terms, iterate, rest); });
    return result;
}

} // namespace rhombloom
