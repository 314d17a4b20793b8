#include "core/form/newton_system.h"

#include <algorithm>

#include "core/form/minimise.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr double rigid_shift = 1e-9; // share of the mean diagonal: holds the rigid motions
constexpr double first_damping = 1e-4;
constexpr int max_attempts = 20;

double mean_diagonal(const BlockMatrix& matrix)
{
    double sum = 0;
    for (int j = 0; j < matrix.size; ++j) {
        const double* block = &matrix.value[9 * std::size_t(matrix.start[j])];
        sum += block[0] + block[4] + block[8];
    }
    return sum / (3.0 * matrix.size);
}

} // namespace

NewtonSystem::NewtonSystem(const EmbeddingTerms& terms, int threads)
    : terms_(terms), hessian_(hessian_matrix(terms, pattern_)), solver_(hessian_, threads), threads_(threads),
      shift_(rigid_shift)
{
    if (is_large(terms)) {
        divide_by(solver_.order(), terms, pattern_);
    }
}

void NewtonSystem::assemble(const Iterate& iterate, const HessianOptions& options)
{
    HessianOptions shared = options;
    shared.threads = threads_;
    embedding_hessian(terms_, pattern_, iterate.x, shared, hessian_);
}

VectorXd NewtonSystem::product(const VectorXd& vector) const
{
    VectorXd result = VectorXd::Zero(vector.size()), free;
    multiply(hessian_, vector.head(3 * terms_.free_count), free);
    result.head(3 * terms_.free_count) = free;
    return result;
}

bool NewtonSystem::factor(const Iterate& iterate, const HessianOptions& options)
{
    assemble(iterate, options);
    return solver_.factor(hessian_, shift_ * mean_diagonal(hessian_));
}

VectorXd NewtonSystem::direction(const Iterate& iterate)
{
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
        if (factor(iterate, {damping_})) {
            if (attempt == 0) {
                lower_damping();
            }
            return -solve(iterate.gradient);
        }
        raise_damping();
    }
    return -iterate.gradient;
}

VectorXd NewtonSystem::solve(const VectorXd& right_side) const
{
    VectorXd solution = VectorXd::Zero(right_side.size());
    solution.head(3 * terms_.free_count) = solver_.solve(right_side.head(3 * terms_.free_count));
    return solution;
}

void NewtonSystem::lower_damping()
{
    damping_ = damping_ <= first_damping ? 0 : damping_ / 8;
    shift_ = std::max(rigid_shift, shift_ / 10);
}

void NewtonSystem::raise_damping()
{
    if (damping_ == 1) {
        shift_ *= 10; // semidefinite up to roundoff: mechanisms of the surface
    }
    damping_ = std::clamp(8 * damping_, first_damping, 1.0);
}

} // namespace rhombloom
