#include <algorithm>
#include <cmath>

#include "core/form/linear_solver.h"
#include "core/form/minimise.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr double rigid_shift = 1e-9; // share of the mean diagonal: holds the rigid motions
constexpr double first_damping = 1e-4;

double mean_diagonal(const BlockMatrix& matrix)
{
    double sum = 0;
    for (int j = 0; j < matrix.size; ++j) {
        const double* block = &matrix.value[9 * std::size_t(matrix.start[j])];
        sum += block[0] + block[4] + block[8];
    }
    return sum / (3.0 * matrix.size);
}

// The Newton system of one problem: pattern and symbolic factorisation are made once.
class NewtonSystem
{
public:
    NewtonSystem(const EmbeddingTerms& terms, int threads)
        : terms_(terms), hessian_(hessian_matrix(terms, pattern_)), solver_(hessian_, threads)
    {
    }

    VectorXd direction(const Iterate& iterate)
    {
        for (int attempt = 0; attempt < max_attempts; ++attempt) {
            embedding_hessian(terms_, pattern_, iterate.x, damping_, hessian_);
            if (solver_.factor(hessian_, shift_ * mean_diagonal(hessian_))) {
                if (attempt == 0) {
                    lower_damping();
                }
                VectorXd step = VectorXd::Zero(iterate.x.size());
                step.head(3 * terms_.free_count) = -solver_.solve(iterate.gradient.head(3 * terms_.free_count));
                return step;
            }
            raise_damping();
        }
        return -iterate.gradient;
    }

private:
    static constexpr int max_attempts = 20;

    void lower_damping()
    {
        damping_ = damping_ <= first_damping ? 0 : damping_ / 8;
        shift_ = std::max(rigid_shift, shift_ / 10);
    }

    void raise_damping()
    {
        if (damping_ == 1) {
            shift_ *= 10; // semidefinite up to roundoff: mechanisms of the surface
        }
        damping_ = std::clamp(8 * damping_, first_damping, 1.0);
    }

    const EmbeddingTerms& terms_;
    HessianPattern pattern_;
    BlockMatrix hessian_;
    LinearSolver solver_;
    double damping_ = 0;
    double shift_ = rigid_shift;
};

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
    if (should_stop(iterate, options, result)) {
        return result;
    }
    NewtonSystem system(terms, options.threads);
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
