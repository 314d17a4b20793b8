#pragma once

#include <functional>

#include "core/form/line_search.h"

namespace rhombloom {

enum class StopReason
{
    Converged,
    Stalled,
    IterationLimit,
    Cancelled
};

struct MinimiseOptions
{
    double tolerance = 1e-9; //!< largest absolute gradient component
    int max_iterations = 500;
    int threads = 1;
    //! Called once per iteration with its number and the iterate; false stops. Empty: never called.
    std::function<bool(int, const Iterate&)> progress;
};

struct MinimiseResult
{
    StopReason reason = StopReason::Stalled;
    int iterations = 0;
};

//! \brief Minimise the energy from \p iterate, leaving the best one there: quasi_newton() while far away, newton()
//! then.
MinimiseResult minimise(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options);

//! \brief Newton's method with the exact Hessian.
//! \details Only where that is not positive definite, a share of its indefinite part is removed: raised until the
//! factorisation succeeds, lowered after every success.
MinimiseResult newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options);

//! \brief Limited-memory BFGS (Nocedal 1980) until the energy hardly falls any more; then the result is Stalled.
//! \details Cheap and as good as Newton's method as long as most of the energy is in short-waved noise.
MinimiseResult quasi_newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options);

//! \brief What both methods ask before each iteration: a reason to stop, if there is one.
bool should_stop(const Iterate& iterate, const MinimiseOptions& options, MinimiseResult& result);

} // namespace rhombloom
