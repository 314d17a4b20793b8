#include <algorithm>
#include <cmath>

#include "core/form/minimise.h"
#include "core/form/newton_system.h"

namespace rhombloom {

namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;

constexpr int max_iterations = 60;
constexpr double first_width = 0.3;       // of the mean hinge angle
constexpr double largest_move = 1;        // la
constexpr double to_boundary = 0.99;      // share of the way to a slack or force of zero
constexpr double largest_imbalance = 100; // of a hinge's slack times force against the mean
constexpr double smallest_step = 0.02;    // share of the direction; below, the Hessian is nearly indefinite
constexpr double arrived = 1e-5;          // gradient; below, it is known which hinges are concave
constexpr double near = 1e-3;             // gradient; below, an indefinite Hessian is not for this method
constexpr double lag = 2;                 // power of the residual that slack times force may not fall behind

// The share of the direction that keeps every value positive.
double share_to_zero(const ArrayXd& values, const ArrayXd& steps)
{
    double share = 1;
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        if (steps[k] < 0) {
            share = std::min(share, values[k] / -steps[k]);
        }
    }
    return share;
}

// The cost w gamma^2 of a concave hinge is the minimum of w (gamma - s)^2 over slacks s >= 0, and its moment -z, with
// the force z = 2 w (s - gamma) >= 0 and s z = 0. Here s and z are unknowns of their own and s z goes to zero
// gradually.
class ConcaveHinges
{
public:
    ConcaveHinges(const EmbeddingTerms& terms, const VectorXd& x)
        : terms_(terms), weight_(terms.hinge_law.concavity_weight * (1 - terms.hinge_law.convex_weight)),
          gradients_(12, terms.hinges.size()), responses_(terms.hinges.size())
    {
        look(x);
        const double width = first_width * angle_.abs().mean();
        const ArrayXd root = (angle_.square() + 4 * width * width).sqrt();
        slack_ = 0.5 * (root + angle_).max(2 * width * width / root);
        force_ = weight_ * (root - angle_).max(2 * width * width / root);
    }

    double mean_product() const { return (slack_ * force_).mean(); }

    // Angles and their gradients at \p x.
    void look(const VectorXd& x)
    {
        angle_.resize(terms_.hinges.size());
        for (std::size_t k = 0; k < terms_.hinges.size(); ++k) {
            const HingeVertices& h = terms_.hinges[k];
            const HingePoints points{x.segment<3>(3 * h[0]), x.segment<3>(3 * h[1]), x.segment<3>(3 * h[2]),
                                     x.segment<3>(3 * h[3])};
            angle_[k] = hinge_angle(points);
            gradients_.col(k) = hinge_angle_gradient(points);
        }
        if (slack_.size() > 0) {
            share_ = force_ / (force_ + 2 * weight_ * slack_);
            gap_ = 2 * weight_ * (slack_ - angle_) - force_;
        }
    }

    // The gradient with the forces instead of the moments of concave hinges.
    VectorXd residual(const Iterate& iterate) const
    {
        return iterate.gradient - spread(force_ + 2 * weight_ * angle_.min(0.0));
    }

    // How the hinges enter the Hessian.
    const std::vector<HingeResponse>& responses()
    {
        for (std::size_t k = 0; k < responses_.size(); ++k) {
            responses_[k] = hinge_response(terms_.hinge_law, angle_[k]);
            responses_[k].moment -= force_[k] + 2 * weight_ * std::min(0.0, angle_[k]);
            responses_[k].stiffness += 2 * weight_ * (share_[k] - (angle_[k] < 0 ? 1.0 : 0.0));
        }
        return responses_;
    }

    // The direction for the products of slack and force to become \p target; the positions' part is returned.
    VectorXd direction(const NewtonSystem& system, const VectorXd& residual, const ArrayXd& target)
    {
        const ArrayXd change = target - slack_ * force_;
        const ArrayXd pull = share_ * (gap_ + 2 * weight_ * change / force_);
        VectorXd step = system.solve(spread(pull) - residual);
        force_step_ = pull - 2 * weight_ * share_ * along(step);
        slack_step_ = (change - slack_ * force_step_) / force_;
        return step;
    }

    // Mehrotra's target: the product that the direction to zero leaves, and its second-order error. While the shape is
    // far from equilibrium, the products do not go ahead of it.
    ArrayXd corrected_target(double residual_norm)
    {
        const double mean = mean_product();
        const double left = ((slack_ + share_to_zero(slack_, slack_step_) * slack_step_) *
                             (force_ + share_to_zero(force_, force_step_) * force_step_))
                                .mean();
        if (first_residual_ == 0) {
            first_residual_ = residual_norm;
            first_product_ = mean;
        }
        const double behind = first_product_ * std::pow(residual_norm / first_residual_, lag);
        return std::max(std::pow(left / mean, 3) * mean, std::min(mean, behind)) - slack_step_ * force_step_;
    }

    double longest_step() const { return std::min(1.0, to_boundary * share_to_zero(slack_, slack_step_)); }

    void advance(double share)
    {
        slack_ += share * slack_step_;
        force_ += std::min(1.0, to_boundary * share_to_zero(force_, force_step_)) * force_step_;
        const double mean = mean_product();
        force_ = force_.max(mean / largest_imbalance / slack_).min(largest_imbalance * mean / slack_);
    }

private:
    VectorXd spread(const ArrayXd& values) const
    {
        VectorXd sum = VectorXd::Zero(3 * terms_.vertex_count);
        for (std::size_t k = 0; k < terms_.hinges.size(); ++k) {
            for (int i = 0; i < 4; ++i) {
                sum.segment<3>(3 * terms_.hinges[k][i]) += values[k] * gradients_.col(k).segment<3>(3 * i);
            }
        }
        return sum;
    }

    ArrayXd along(const VectorXd& step) const
    {
        ArrayXd changes = ArrayXd::Zero(terms_.hinges.size());
        for (std::size_t k = 0; k < terms_.hinges.size(); ++k) {
            for (int i = 0; i < 4; ++i) {
                changes[k] += gradients_.col(k).segment<3>(3 * i).dot(step.segment<3>(3 * terms_.hinges[k][i]));
            }
        }
        return changes;
    }

    const EmbeddingTerms& terms_;
    double weight_;
    double first_residual_ = 0;
    double first_product_ = 0;
    Eigen::Matrix<double, 12, Eigen::Dynamic> gradients_;
    std::vector<HingeResponse> responses_;
    ArrayXd angle_, slack_, force_, share_, gap_, slack_step_, force_step_;
};

// One step of Mehrotra's predictor and corrector, if the Hessian with that damping is good for one.
bool interior_step(NewtonSystem& system, ConcaveHinges& hinges, Iterate& iterate, const EmbeddingTerms& terms,
                   double damping)
{
    HessianOptions options;
    options.damping = damping;
    options.hinges = &hinges.responses();
    if (!system.factor(iterate, options)) {
        return false;
    }
    const VectorXd residual = hinges.residual(iterate);
    hinges.direction(system, residual, ArrayXd::Zero(terms.hinges.size()));
    const VectorXd step = hinges.direction(system, residual, hinges.corrected_target(residual.norm()));
    const double move = std::sqrt(step.reshaped(3, terms.vertex_count).colwise().squaredNorm().maxCoeff());
    const double share = std::min(hinges.longest_step(), largest_move / move);
    if (!(share > smallest_step)) {
        return false;
    }
    hinges.advance(share);
    iterate = iterate_at(terms, iterate.x + share * step);
    return std::isfinite(iterate.energy);
}

// A step with as little damping as will do; false when the iteration is stuck. An edge that is shorter than in
// equilibrium by a thousandth has lost its tension, and with it what holds its ends in place; a damped step gives it
// back.
bool damped_step(NewtonSystem& system, ConcaveHinges& hinges, Iterate& iterate, const EmbeddingTerms& terms)
{
    hinges.look(iterate.x);
    for (const double damping : {0.0, 0.1, 0.3, 1.0}) {
        if (damping > 0 && iterate.gradient_norm() < near) {
            return false;
        }
        if (interior_step(system, hinges, iterate, terms, damping)) {
            return true;
        }
    }
    return false;
}

} // namespace

MinimiseResult interior_descent(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& iterate,
                                const MinimiseOptions& options)
{
    MinimiseResult result;
    if (terms.hinges.empty() || terms.hinge_law.concavity_weight <= 0 || terms.hinge_law.convex_weight >= 1) {
        return result;
    }
    Iterate now = iterate;
    ConcaveHinges hinges(terms, now.x);
    while (now.gradient_norm() > arrived && !should_stop(now, options, result) && result.iterations < max_iterations &&
           damped_step(system, hinges, now, terms)) {
        ++result.iterations;
        if (now.energy < iterate.energy) {
            iterate = now;
        }
    }
    should_stop(iterate, options, result);
    return result;
}

} // namespace rhombloom
