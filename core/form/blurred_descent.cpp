#include <algorithm>
#include <cmath>

#include "core/form/newton_system.h"
#include "core/form/quasi_newton.h"

namespace rhombloom {

namespace {

constexpr int max_cycles = 12;
constexpr double settled_decrease = 1e-8; // relative, over a cycle
constexpr double first_damping = 0.1;
constexpr double first_floor = 0.01;

// As many as cost about as much as a factorisation.
int steps_per_cycle(const EmbeddingTerms& terms)
{
    return std::clamp(static_cast<int>(15 * std::sqrt(terms.vertex_count / 30000.0)), 15, 40);
}

double mean_hinge_angle(const EmbeddingTerms& terms, const Eigen::VectorXd& x)
{
    double sum = 0;
    for (const HingeVertices& h : terms.hinges) {
        sum += std::abs(hinge_angle(
            {x.segment<3>(3 * h[0]), x.segment<3>(3 * h[1]), x.segment<3>(3 * h[2]), x.segment<3>(3 * h[3])}));
    }
    return terms.hinges.empty() ? 0 : sum / double(terms.hinges.size());
}

} // namespace

MinimiseResult blurred_descent(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& iterate,
                               const MinimiseOptions& options)
{
    MinimiseResult result;
    LimitedMemory memory(20);
    const LimitedMemory::Seed seed = [&](const Eigen::VectorXd& gradient) { return system.solve(gradient); };
    HessianOptions blurred{first_damping, 0.1 * mean_hinge_angle(terms, iterate.x), first_floor};
    const int steps = steps_per_cycle(terms);
    for (int cycle = 0; cycle < max_cycles && system.factor_blurred(iterate, blurred); ++cycle) {
        const double before = iterate.energy;
        for (int k = 0; k < steps; ++k, ++result.iterations) {
            if (should_stop(iterate, options, result)) {
                return result;
            }
            if (!quasi_newton_step(terms, iterate, memory, seed)) {
                return result;
            }
        }
        if (before - iterate.energy < settled_decrease * before) {
            break;
        }
        blurred = {0, blurred.hinge_blur / 2, blurred.hinge_floor / 2};
    }
    return result;
}

} // namespace rhombloom
