#include "core/form/minimise.h"

#include <algorithm>
#include <future>

#include "core/form/newton_system.h"

namespace rhombloom {

namespace {

constexpr int settled_in = 16; // quasi-Newton steps; who wants a quick look has stopped before

// The system of Newton's method, set up on the way while quasi-Newton steps leave a thread idle.
class PreparedSystem
{
public:
    PreparedSystem(const EmbeddingTerms& terms, int threads) : terms_(terms), threads_(threads) {}

    void prepare()
    {
        if (is_large(terms_) && threads_ > 1) {
            coming_ = std::async(std::launch::async, [this] { return made(); });
        }
    }

    NewtonSystem& get()
    {
        if (!system_) {
            system_ = coming_.valid() ? coming_.get() : made();
        }
        return *system_;
    }

private:
    std::unique_ptr<NewtonSystem> made() const { return std::make_unique<NewtonSystem>(terms_, threads_); }

    const EmbeddingTerms& terms_;
    int threads_;
    std::unique_ptr<NewtonSystem> system_;
    std::future<std::unique_ptr<NewtonSystem>> coming_;
};

} // namespace

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
    PreparedSystem system(terms, options.threads);
    MinimiseOptions watched = options;
    watched.progress = [&](int iteration, const Iterate& now) {
        if (iteration == settled_in) {
            system.prepare();
        }
        return !options.progress || options.progress(iteration, now);
    };
    MinimiseResult result = quasi_newton(terms, iterate, watched);
    const auto go_on = [&](auto&& method) {
        if (result.reason == StopReason::Stalled) {
            const int before = result.iterations;
            result = method(system.get(), rest_of(options, before));
            result.iterations += before;
        }
    };
    if (is_large(terms)) {
        go_on([&](NewtonSystem& newton, const MinimiseOptions& rest) {
            return interior_descent(terms, newton, iterate, rest);
        });
    }
    go_on([&](NewtonSystem& newton, MinimiseOptions rest) {
        rest.max_iterations = std::min(rest.max_iterations, options.max_newton_iterations);
        return newton_with(newton, terms, iterate, rest);
    });
    return result;
}

} // namespace rhombloom
