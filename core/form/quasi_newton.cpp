#include "core/form/quasi_newton.h"

#include <deque>

#include "core/form/graph_laplacian.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr int window = 10;         // iterations over which the decrease is judged
constexpr double first_move = 0.1; // la
constexpr LaplacianWeights metric = {10, 1, 0.1};

// Has the energy hardly fallen for a while?
class Slowness
{
public:
    explicit Slowness(double decrease) : decrease_(decrease) {}

    bool shows(double energy)
    {
        energies_.push_back(energy);
        if (energies_.size() > window + 1) {
            energies_.pop_front();
        }
        return energies_.size() > window && energies_.front() - energies_.back() < decrease_ * energies_.front();
    }

private:
    double decrease_; // relative, over the window
    std::deque<double> energies_;
};

// Steepest descent by the lengths of the first step, in the metric of the springs on a large surface: there long waves
// would take as many iterations as the surface has elements across.
LimitedMemory::Seed laplacian_seed(const EmbeddingTerms& terms)
{
    return [laplacian = std::make_shared<const GraphLaplacian>(terms, metric)](const VectorXd& gradient) -> VectorXd {
        return laplacian->solve(gradient.reshaped(3, gradient.size() / 3).transpose()).transpose().reshaped();
    };
}

} // namespace

bool quasi_newton_step(const EmbeddingTerms& terms, Iterate& iterate, LimitedMemory& memory,
                       const LimitedMemory::Seed& seed)
{
    const Iterate last = iterate;
    const bool steepest = memory.empty() && !seed;
    const VectorXd direction = steepest ? VectorXd(-first_move / iterate.gradient_norm() * iterate.gradient)
                                        : memory.direction(iterate.gradient, seed);
    if (line_search(terms, iterate, direction, {1, 2}) > 0) {
        memory.remember(iterate.x - last.x, iterate.gradient - last.gradient);
        return true;
    }
    const bool had_memory = !memory.empty();
    memory.clear();
    return had_memory;
}

MinimiseResult quasi_newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options)
{
    MinimiseResult result;
    const bool large = is_large(terms);
    LimitedMemory memory(large ? 20 : 10);
    Slowness slowness(large ? 1e-3 : 1e-4);
    LimitedMemory::Seed seed;
    for (; !should_stop(iterate, options, result); ++result.iterations) {
        if (slowness.shows(iterate.energy)) {
            break;
        }
        if (large && !seed) {
            seed = laplacian_seed(terms);
        }
        if (!quasi_newton_step(terms, iterate, memory, seed)) {
            break;
        }
    }
    return result;
}

} // namespace rhombloom
