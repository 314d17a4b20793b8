#include "core/form/line_search.h"

#include <algorithm>
#include <cmath>

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr double armijo = 1e-4;
constexpr double energy_roundoff = 1e-13; // relative error of a summed energy
constexpr int max_trials = 30;

double largest_move(const VectorXd& step)
{
    return std::sqrt(step.reshaped(3, step.size() / 3).colwise().squaredNorm().maxCoeff());
}

bool is_acceptable(const Iterate& from, const Iterate& to, double scale, double slope)
{
    if (to.energy <= from.energy + armijo * scale * slope) {
        return true;
    }
    const double noise = energy_roundoff * std::abs(from.energy);
    return -scale * slope < 10 * noise && to.energy <= from.energy + noise && to.gradient_norm() < from.gradient_norm();
}

// Minimum of the parabola through the energy and slope here and the energy there.
double shorter(const Iterate& from, const Iterate& to, double scale, double slope)
{
    if (!std::isfinite(to.energy)) {
        return scale / 10;
    }
    const double quadratic = -slope * scale * scale / (2 * (to.energy - from.energy - slope * scale));
    return std::clamp(quadratic, 0.1 * scale, 0.5 * scale);
}

} // namespace

Iterate iterate_at(const EmbeddingTerms& terms, VectorXd x)
{
    Iterate iterate;
    iterate.x = std::move(x);
    iterate.energy = embedding_gradient(terms, iterate.x, iterate.gradient).total();
    return iterate;
}

double line_search(const EmbeddingTerms& terms, Iterate& iterate, const VectorXd& direction,
                   const LineSearchOptions& options)
{
    return line_search([&](VectorXd x) { return iterate_at(terms, std::move(x)); }, iterate, direction, options);
}

double line_search(const std::function<Iterate(VectorXd)>& at, Iterate& iterate, const VectorXd& direction,
                   const LineSearchOptions& options)
{
    const double slope = direction.dot(iterate.gradient);
    if (!(slope < 0)) {
        return 0;
    }
    double scale = std::min(options.first_step, options.max_move / largest_move(direction));
    for (int k = 0; k < max_trials; ++k) {
        Iterate next = at(iterate.x + scale * direction);
        if (is_acceptable(iterate, next, scale, slope)) {
            iterate = std::move(next);
            return scale;
        }
        scale = shorter(iterate, next, scale, slope);
    }
    return 0;
}

} // namespace rhombloom
