#include <deque>

#include "core/form/minimise.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr int memory = 10;
constexpr int window = 10;             // iterations over which the decrease is judged
constexpr double slow_decrease = 1e-4; // relative, over the window
constexpr double first_move = 0.1;     // la

struct Correction
{
    VectorXd step;
    VectorXd change; // of the gradient
    double curvature;
};

// The two-loop recursion.
VectorXd direction(const VectorXd& gradient, const std::deque<Correction>& corrections)
{
    VectorXd d = -gradient;
    std::vector<double> alpha(corrections.size());
    for (std::size_t k = corrections.size(); k-- > 0;) {
        alpha[k] = corrections[k].step.dot(d) / corrections[k].curvature;
        d -= alpha[k] * corrections[k].change;
    }
    if (corrections.empty()) {
        return first_move / gradient.lpNorm<Eigen::Infinity>() * d;
    }
    d *= corrections.back().curvature / corrections.back().change.squaredNorm();
    for (std::size_t k = 0; k < corrections.size(); ++k) {
        const double beta = corrections[k].change.dot(d) / corrections[k].curvature;
        d += (alpha[k] - beta) * corrections[k].step;
    }
    return d;
}

void remember(std::deque<Correction>& corrections, VectorXd step, VectorXd change)
{
    const double curvature = step.dot(change);
    if (curvature > 1e-10 * step.norm() * change.norm()) {
        corrections.push_back({std::move(step), std::move(change), curvature});
    }
    if (corrections.size() > memory) {
        corrections.pop_front();
    }
}

bool is_slow(const std::deque<double>& energies)
{
    return energies.size() > window && energies.front() - energies.back() < slow_decrease * energies.front();
}

} // namespace

MinimiseResult quasi_newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options)
{
    MinimiseResult result;
    std::deque<Correction> corrections;
    std::deque<double> energies;
    for (; !should_stop(iterate, options, result); ++result.iterations) {
        energies.push_back(iterate.energy);
        if (energies.size() > window + 1) {
            energies.pop_front();
        }
        if (is_slow(energies)) {
            break;
        }
        const Iterate last = iterate;
        if (!line_search(terms, iterate, direction(iterate.gradient, corrections), {1, 2})) {
            if (corrections.empty()) {
                break;
            }
            corrections.clear();
            continue;
        }
        remember(corrections, iterate.x - last.x, iterate.gradient - last.gradient);
    }
    return result;
}

} // namespace rhombloom
