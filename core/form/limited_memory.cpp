#include "core/form/limited_memory.h"

#include <vector>

#include "core/expected.h"

namespace rhombloom {

using Eigen::VectorXd;

void LimitedMemory::remember(VectorXd step, VectorXd change_of_gradient)
{
    const double curvature = step.dot(change_of_gradient);
    if (curvature > 1e-10 * step.norm() * change_of_gradient.norm()) {
        corrections_.push_back({std::move(step), std::move(change_of_gradient), curvature});
    }
    if (corrections_.size() > length_) {
        corrections_.pop_front();
    }
}

VectorXd LimitedMemory::direction(const VectorXd& gradient, const Seed& seed) const
{
    expects(seed || !empty(), "LimitedMemory::direction: a seed or a memory");
    VectorXd d = -gradient;
    std::vector<double> alpha(corrections_.size());
    for (std::size_t k = corrections_.size(); k-- > 0;) {
        alpha[k] = corrections_[k].step.dot(d) / corrections_[k].curvature;
        d -= alpha[k] * corrections_[k].change;
    }
    if (seed) {
        d = seed(d);
    } else {
        d *= corrections_.back().curvature / corrections_.back().change.squaredNorm();
    }
    for (std::size_t k = 0; k < corrections_.size(); ++k) {
        const double beta = corrections_[k].change.dot(d) / corrections_[k].curvature;
        d += (alpha[k] - beta) * corrections_[k].step;
    }
    return d;
}

} // namespace rhombloom
