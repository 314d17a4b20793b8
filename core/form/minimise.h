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
    int max_newton_iterations = 10000; //!< of minimise()
    int threads = 1;
    //! Called once per iteration with its number and the iterate; false stops. Empty: never called.
    std::function<bool(int, const Iterate&)> progress;
};

struct MinimiseResult
{
    StopReason reason = StopReason::Stalled;
    int iterations = 0;
};

class NewtonSystem;

//! \brief Is the surface so large that long waves need a method of their own?
bool is_large(const EmbeddingTerms& terms);

//! \brief Minimise the energy from \p iterate, leaving the best one there: quasi_newton() while far away, on large
//! surfaces interior_descent(), newton() in the end.
MinimiseResult minimise(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options);

//! \brief Newton's method with the exact Hessian where that is positive definite (NewtonSystem::direction()).
MinimiseResult newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options);
MinimiseResult newton_with(NewtonSystem& system, const EmbeddingTerms& terms, Iterate& iterate,
                           const MinimiseOptions& options);

//! \brief Limited-memory BFGS until the energy hardly falls any more; then the result is Stalled.
//! \details Cheap and as good as Newton's method as long as most of the energy is in short-waved noise. On a large
//! surface it is seeded with the Laplacian of the springs, as Liu et al. 2017 do, which takes care of the long waves.
MinimiseResult quasi_newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options);

//! \brief A primal-dual interior-point method for the concave hinges, until it is known which these are; then the
//! result is Stalled, or Converged if the last factor was good enough for the rest.
//! \details On a large surface whole regions are nearly flat, and which of their hinges are concave is open to the
//! last. Slack and moment of every hinge are unknowns of their own, and how much of each bears load is settled for all
//! of them together (Mehrotra 1992), in a dozen factorisations whatever the size.
MinimiseResult interior_descent(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& iterate,
                                const MinimiseOptions& options);

//! \brief The same from near an equilibrium where the Hessian is indefinite: first to a point of the method's central
//! path where it is not, see smoothed_descent(). \p share: how far along the path that is; smaller is nearer to its
//! end.
MinimiseResult interior_descent_near(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& iterate,
                                     const MinimiseOptions& options, double share);

//! \brief For a method that begins after \p done iterations.
MinimiseOptions rest_of(const MinimiseOptions& options, int done);

//! \brief What all methods ask before each iteration: a reason to stop, if there is one.
bool should_stop(const Iterate& iterate, const MinimiseOptions& options, MinimiseResult& result);

} // namespace rhombloom
