#include "core/form/smoothed_descent.h"

#include <algorithm>
#include <cmath>

#include "core/form/parallel.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr double close_enough = 0.02; // gradient with the width against the exact one
constexpr double most_move = 0.3;     // la, in one step
constexpr int most_steps = 8;         // with one width
constexpr int portions = 16;          // of the hinges

// A hinge that is stiff by a share that falls from 1 to 0 where its angle goes from minus to plus a few widths.
struct Rounded
{
    HingeResponse response;
    double energy = 0; // more than the exact one
    double moment = 0; // more than the exact one
};

Rounded rounded(const HingeLaw& law, double angle, double width)
{
    const double weight = law.concavity_weight * (1 - law.convex_weight);
    const double root = std::sqrt(angle * angle + 4 * width * width);
    const double bent = angle > 0 ? -2 * width * width / (root + angle) : (angle - root) / 2;
    const double concave = std::min(angle, 0.0);
    Rounded out;
    out.energy = weight * (angle * bent - 2 * width * width * std::asinh(angle / (2 * width)) - concave * concave);
    out.moment = 2 * weight * (bent - concave);
    out.response = shared_response(law, angle, (1 - angle / root) / 2);
    out.response.moment += out.moment;
    return out;
}

// The energy with rounded hinges.
class Smoothed
{
public:
    Smoothed(const EmbeddingTerms& terms, double width, int threads)
        : terms_(terms), width_(width), threads_(threads), hinges_(terms.hinges.size()),
          gradients_(12, terms.hinges.size())
    {
    }

    Iterate at(const Iterate& exact)
    {
        const std::size_t count = terms_.hinges.size();
        parallel_tasks(threads_, portions, [&](int portion) {
            for (std::size_t k = count * portion / portions; k < count * (portion + 1) / portions; ++k) {
                const HingePoints points = hinge_points(exact.x, terms_.hinges[k]);
                hinges_[k] = rounded(terms_.hinge_law, hinge_angle(points), width_);
                gradients_.col(k) = hinges_[k].moment * hinge_angle_gradient(points);
            }
        });
        Iterate out = exact;
        for (std::size_t k = 0; k < count; ++k) {
            out.energy += hinges_[k].energy;
            for (int i = 0; i < 4; ++i) {
                out.gradient.segment<3>(3 * terms_.hinges[k][i]) += gradients_.col(k).segment<3>(3 * i);
            }
        }
        out.gradient.tail(3 * (terms_.vertex_count - terms_.free_count)).setZero();
        return out;
    }

    //! \brief Of the hinges at the last positions.
    std::vector<HingeResponse> responses() const
    {
        std::vector<HingeResponse> out(hinges_.size());
        std::transform(hinges_.begin(), hinges_.end(), out.begin(), [](const Rounded& r) { return r.response; });
        return out;
    }

private:
    const EmbeddingTerms& terms_;
    double width_;
    int threads_;
    std::vector<Rounded> hinges_;
    Eigen::Matrix<double, 12, Eigen::Dynamic> gradients_;
};

// Conjugate gradients for Newton's direction with the assembled Hessian, preconditioned with the factored one, as far
// as they find no negative curvature (Steihaug 1983); if that is what they begin with, the direction that has it.
VectorXd truncated_direction(const NewtonSystem& system, const VectorXd& gradient)
{
    constexpr int most = 40;
    constexpr double solved = 1e-6; // share of the squared residual
    VectorXd direction = VectorXd::Zero(gradient.size());
    VectorXd residual = gradient, reduced = system.solve(residual), search = -reduced;
    const double first = residual.dot(reduced);
    double now = first;
    for (int k = 0; k < most && now > solved * first; ++k) {
        const VectorXd change = system.product(search);
        const double curvature = search.dot(change);
        if (curvature <= 0) {
            return k == 0 ? search : direction;
        }
        direction += now / curvature * search;
        residual += now / curvature * change;
        reduced = system.solve(residual);
        const double next = residual.dot(reduced);
        search = next / now * search - reduced;
        now = next;
    }
    return direction;
}

// Newton's direction, as little of the indefinite part removed from the factored Hessian as will do; how much that is.
double newton_direction(NewtonSystem& system, const Iterate& smoothed, const std::vector<HingeResponse>& hinges,
                        VectorXd& direction)
{
    for (const double damping : {0.0, 0.01, 0.1, 0.3, 1.0}) {
        if (system.factor(smoothed, {damping, &hinges})) {
            if (damping == 0) {
                direction = -system.solve(smoothed.gradient);
            } else {
                system.assemble(smoothed, {0, &hinges});
                direction = truncated_direction(system, smoothed.gradient);
            }
            return damping;
        }
    }
    direction = -smoothed.gradient;
    return 1;
}

// Away from a saddle the first steps are as small as the gradient is there, and the energy falls for much longer: twice
// as far each time while it does.
template <class At>
void go_on(const At& at, const VectorXd& from, const VectorXd& direction, double share, Iterate& iterate)
{
    const double farthest =
        most_move / std::sqrt(direction.reshaped(3, direction.size() / 3).colwise().squaredNorm().maxCoeff());
    for (double next = 2 * share; next < farthest; next *= 2) {
        Iterate trial = at(from + next * direction);
        if (!(trial.energy < iterate.energy)) {
            return;
        }
        iterate = std::move(trial);
    }
}

} // namespace

bool smoothed_descent(const EmbeddingTerms& terms, NewtonSystem& system, Iterate& now, double width,
                      const MinimiseOptions& options, MinimiseResult& result)
{
    Smoothed energy(terms, width, options.threads);
    double damping = 1;
    for (int k = 0; k < most_steps; ++k) {
        Iterate smoothed = energy.at(now);
        if (damping == 0 && smoothed.gradient_norm() < close_enough * now.gradient_norm()) {
            break;
        }
        VectorXd direction;
        damping = newton_direction(system, smoothed, energy.responses(), direction);
        const auto at = [&](VectorXd x) { return energy.at(iterate_at(terms, std::move(x))); };
        const VectorXd from = smoothed.x;
        const double share = line_search(at, smoothed, direction, {1, most_move});
        if (share == 0) {
            return k > 0;
        }
        if (damping > 0) {
            go_on(at, from, direction, share, smoothed);
        }
        now = iterate_at(terms, std::move(smoothed.x));
        ++result.iterations;
        if (should_stop(now, options, result)) {
            return false;
        }
    }
    return true;
}

} // namespace rhombloom
