#include "core/form/concave_hinges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/form/parallel.h"

namespace rhombloom {

using Eigen::ArrayXd;
using Eigen::VectorXd;

namespace {

constexpr double first_width = 0.3;       // of the mean hinge angle
constexpr double to_boundary = 0.99;      // share of the way to a slack or force of zero
constexpr double largest_imbalance = 100; // of a hinge's slack times force against the mean
constexpr double lag = 2;                 // power of the residual that slack times force may not fall behind
constexpr int portions = 16;              // of the hinges

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

} // namespace

ConcaveHinges::ConcaveHinges(const EmbeddingTerms& terms, const VectorXd& x, int threads)
    : terms_(terms), threads_(threads), weight_(terms.hinge_law.concavity_weight * (1 - terms.hinge_law.convex_weight)),
      responses_(terms.hinges.size()), angle_(terms.hinges.size()), gradients_(12, terms.hinges.size())
{
    find_angles(x);
    round_off(first_width * mean_angle());
}

double ConcaveHinges::width() const
{
    return std::sqrt(mean_product() / (2 * weight_));
}

void ConcaveHinges::put_on_path(const VectorXd& x, double width)
{
    find_angles(x);
    round_off(width);
    first_residual_ = std::numeric_limits<double>::infinity(); // nothing to wait for
}

void ConcaveHinges::round_off(double width)
{
    const ArrayXd root = (angle_.square() + 4 * width * width).sqrt();
    slack_ = 0.5 * (root + angle_).max(2 * width * width / root);
    force_ = weight_ * (root - angle_).max(2 * width * width / root);
}

void ConcaveHinges::find_angles(const VectorXd& x)
{
    const std::size_t count = terms_.hinges.size();
    parallel_tasks(threads_, portions, [&](int portion) {
        for (std::size_t k = count * portion / portions; k < count * (portion + 1) / portions; ++k) {
            const HingePoints points = hinge_points(x, terms_.hinges[k]);
            angle_[k] = hinge_angle(points);
            gradients_.col(k) = hinge_angle_gradient(points);
        }
    });
}

void ConcaveHinges::look(const VectorXd& x)
{
    find_angles(x);
    share_ = force_ / (force_ + 2 * weight_ * slack_);
    gap_ = 2 * weight_ * (slack_ - angle_) - force_;
}

VectorXd ConcaveHinges::residual(const Iterate& iterate) const
{
    return iterate.gradient - spread(force_ + 2 * weight_ * angle_.min(0.0));
}

const std::vector<HingeResponse>& ConcaveHinges::responses()
{
    for (std::size_t k = 0; k < responses_.size(); ++k) {
        responses_[k] = shared_response(terms_.hinge_law, angle_[k], share_[k]);
        responses_[k].moment -= force_[k] + 2 * weight_ * std::min(0.0, angle_[k]);
    }
    return responses_;
}

VectorXd ConcaveHinges::direction(const NewtonSystem& system, const VectorXd& residual, const ArrayXd& target)
{
    const ArrayXd change = target - slack_ * force_;
    const ArrayXd pull = share_ * (gap_ + 2 * weight_ * change / force_);
    VectorXd step = system.solve(spread(pull) - residual);
    force_step_ = pull - 2 * weight_ * share_ * along(step);
    slack_step_ = (change - slack_ * force_step_) / force_;
    return step;
}

ArrayXd ConcaveHinges::corrected_target(double residual_norm)
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

double ConcaveHinges::longest_step() const
{
    return std::min(1.0, to_boundary * share_to_zero(slack_, slack_step_));
}

void ConcaveHinges::advance(double share)
{
    slack_ += share * slack_step_;
    force_ += std::min(1.0, to_boundary * share_to_zero(force_, force_step_)) * force_step_;
    const double mean = mean_product();
    force_ = force_.max(mean / largest_imbalance / slack_).min(largest_imbalance * mean / slack_);
}

VectorXd ConcaveHinges::spread(const ArrayXd& values) const
{
    VectorXd sum = VectorXd::Zero(3 * terms_.vertex_count);
    for (std::size_t k = 0; k < terms_.hinges.size(); ++k) {
        for (int i = 0; i < 4; ++i) {
            sum.segment<3>(3 * terms_.hinges[k][i]) += values[k] * gradients_.col(k).segment<3>(3 * i);
        }
    }
    return sum;
}

ArrayXd ConcaveHinges::along(const VectorXd& step) const
{
    ArrayXd changes = ArrayXd::Zero(terms_.hinges.size());
    for (std::size_t k = 0; k < terms_.hinges.size(); ++k) {
        for (int i = 0; i < 4; ++i) {
            changes[k] += gradients_.col(k).segment<3>(3 * i).dot(step.segment<3>(3 * terms_.hinges[k][i]));
        }
    }
    return changes;
}

} // namespace rhombloom
