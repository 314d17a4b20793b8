#pragma once

#include <functional>

#include "core/form/embedding_energy.h"

namespace rhombloom {

struct NewtonOptions
{
    double tolerance = 1e-9; //!< largest absolute gradient component
    int max_iterations = 500;
    double max_step = 2; //!< la per vertex and iteration
    //! Called once per iteration with its number, energy and gradient norm; false stops. Empty: never called.
    std::function<bool(int, double, double)> progress;
};

enum class StopReason
{
    Converged,
    Stalled,
    IterationLimit,
    Cancelled
};

struct NewtonResult
{
    StopReason reason = StopReason::Stalled;
    int iterations = 0;
    double gradient_norm = 0;
};

//! \brief Minimise the energy from \p x, leaving the best iterate there.
//! \details Newton's method with the exact Hessian. Only when it is not positive definite, a share of its indefinite
//! part is removed: raised until the factorisation succeeds, lowered after every success.
NewtonResult newton(const EmbeddingTerms& terms, Eigen::VectorXd& x, const NewtonOptions& options);

} // namespace rhombloom
