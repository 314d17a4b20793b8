#include "core/form/newton.h"

#include <algorithm>
#include <cmath>

#include "core/form/linear_solver.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr double armijo = 1e-4;
constexpr double energy_roundoff = 1e-13; // relative error of a summed energy
constexpr double rigid_shift = 1e-9;      // share of the mean diagonal: holds the rigid motions

struct State
{
    VectorXd x;
    VectorXd gradient;
    double energy = 0;

    double gradient_norm() const { return gradient.lpNorm<Eigen::Infinity>(); }
};

State state_at(const EmbeddingTerms& terms, VectorXd x)
{
    State state;
    state.x = std::move(x);
    state.energy = embedding_gradient(terms, state.x, state.gradient).total();
    return state;
}

double mean_diagonal(const BlockMatrix& matrix)
{
    double sum = 0;
    for (int j = 0; j < matrix.size; ++j) {
        const double* block = &matrix.value[9 * matrix.start[j]];
        sum += block[0] + block[4] + block[8];
    }
    return sum / (3.0 * matrix.size);
}

// The Newton system of one problem: pattern and symbolic factorisation are made once.
class NewtonSystem
{
public:
    explicit NewtonSystem(const EmbeddingTerms& terms)
        : terms_(terms), hessian_(hessian_matrix(terms, pattern_)), solver_(hessian_)
    {
    }

    VectorXd direction(const State& state)
    {
        for (int attempt = 0; attempt < max_attempts; ++attempt) {
            embedding_hessian(terms_, pattern_, state.x, damping_, hessian_);
            if (solver_.factor(hessian_, shift_ * mean_diagonal(hessian_))) {
                if (attempt == 0) {
                    lower_damping();
                }
                return -solver_.solve(state.gradient);
            }
            raise_damping();
        }
        return -state.gradient;
    }

private:
    static constexpr int max_attempts = 20;

    void lower_damping()
    {
        damping_ = damping_ < 1e-4 ? 0 : damping_ / 8;
        shift_ = std::max(rigid_shift, shift_ / 10);
    }

    void raise_damping()
    {
        if (damping_ == 1) {
            shift_ *= 10; // semidefinite up to roundoff: mechanisms of the surface
        }
        damping_ = std::clamp(8 * damping_, 1e-4, 1.0);
    }

    const EmbeddingTerms& terms_;
    HessianPattern pattern_;
    BlockMatrix hessian_;
    LinearSolver solver_;
    double damping_ = 0;
    double shift_ = rigid_shift;
};

double largest_move(const VectorXd& step)
{
    return std::sqrt(step.reshaped(3, step.size() / 3).colwise().squaredNorm().maxCoeff());
}

bool is_acceptable(const State& from, const State& to, double scale, double slope)
{
    const double predicted = armijo * scale * slope;
    if (to.energy <= from.energy + predicted) {
        return true;
    }
    // Where the decrease drowns in roundoff, the gradient decides.
    const double noise = energy_roundoff * std::abs(from.energy);
    return -scale * slope < 10 * noise && to.energy <= from.energy + noise && to.gradient_norm() < from.gradient_norm();
}

double shorter(const State& from, const State& to, double scale, double slope)
{
    if (!std::isfinite(to.energy)) {
        return scale / 10;
    }
    const double quadratic = -slope * scale * scale / (2 * (to.energy - from.energy - slope * scale));
    return std::clamp(quadratic, 0.1 * scale, 0.5 * scale);
}

// One step along \p direction; false when no length helps.
bool line_search(const EmbeddingTerms& terms, State& state, const VectorXd& direction, double max_step)
{
    const double slope = direction.dot(state.gradient);
    if (!(slope < 0)) {
        return false;
    }
    double scale = std::min(1.0, max_step / largest_move(direction));
    for (int k = 0; k < 30; ++k) {
        State next = state_at(terms, state.x + scale * direction);
        if (is_acceptable(state, next, scale, slope)) {
            state = std::move(next);
            return true;
        }
        scale = shorter(state, next, scale, slope);
    }
    return false;
}

} // namespace

NewtonResult newton(const EmbeddingTerms& terms, VectorXd& x, const NewtonOptions& options)
{
    NewtonSystem system(terms);
    State state = state_at(terms, x);
    NewtonResult result;
    for (;; ++result.iterations) {
        result.gradient_norm = state.gradient_norm();
        if (result.gradient_norm <= options.tolerance) {
            result.reason = StopReason::Converged;
            break;
        }
        if (options.progress && !options.progress(result.iterations, state.energy, result.gradient_norm)) {
            result.reason = StopReason::Cancelled;
            break;
        }
        if (result.iterations == options.max_iterations) {
            result.reason = StopReason::IterationLimit;
            break;
        }
        if (!line_search(terms, state, system.direction(state), options.max_step)) {
            result.reason = StopReason::Stalled;
            break;
        }
    }
    x = state.x;
    return result;
}

} // namespace rhombloom
