#include "core/form/lower_equilibrium.h"

#include <algorithm>

#include "core/form/local_newton.h"
#include "core/form/start_shape.h"

namespace rhombloom {

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int most_vertices = 2000;
constexpr double barrier = 1;      // la; a pull that costs more leads nowhere
constexpr double new_place = 1e-3; // la; when no vertex has moved more, all have come back
constexpr double slack = 0.05;     // la; about what the rest of the surface may yield in the end
constexpr double concave = -0.02;  // radians
constexpr double gain = 1e-9;      // relative
constexpr int local_iterations = 30;

class Search
{
public:
    Search(const EmbeddingTerms& terms, Attempt& best, const MinimiseOptions& options)
        : terms_(terms), best_(best), options_(options), neighbours_(spring_neighbours(terms)),
          hinges_(terms.vertex_count)
    {
        for (const HingeVertices& h : terms.hinges) {
            hinges_[h[0]].push_back(h);
        }
        free_.max_iterations = held_.max_iterations = local_iterations;
        free_.tolerance = options.tolerance;
        held_.tolerance = 1e-4;
        free_.progress = held_.progress = options.progress;
    }

    void run()
    {
        int without_gain = 0;
        for (int v = 0; without_gain < terms_.vertex_count && !cancelled_; v = (v + 1) % terms_.vertex_count) {
            without_gain = is_candidate(v) && (pull(v, 1) || pull(v, -1)) ? 0 : without_gain + 1;
        }
    }

private:
    // Is there a concave hinge at the vertex or at a neighbour?
    bool is_candidate(int v) const
    {
        return !hinges_[v].empty() &&
               (has_concave_hinge(v) ||
                std::any_of(neighbours_[v].begin(), neighbours_[v].end(), [&](int w) { return has_concave_hinge(w); }));
    }

    bool has_concave_hinge(int v) const
    {
        const VectorXd& x = best_.iterate.x;
        return std::any_of(hinges_[v].begin(), hinges_[v].end(),
                           [&](const HingeVertices& h) { return hinge_angle(hinge_points(x, h)) < concave; });
    }

    Vector3d normal_at(int v) const
    {
        const VectorXd& x = best_.iterate.x;
        Vector3d sum = Vector3d::Zero();
        for (const HingeVertices& h : hinges_[v]) {
            sum += hinge_normal(hinge_points(x, h));
        }
        return sum.normalized();
    }

    std::vector<bool> around(int v) const
    {
        std::vector<bool> out(terms_.vertex_count, false);
        for (const int w : neighbours_[v]) {
            out[w] = true;
            for (const int u : neighbours_[w]) {
                out[u] = true;
            }
        }
        return out;
    }

    void solve(const std::vector<bool>& is_free, Iterate& iterate, const MinimiseOptions& options)
    {
        const MinimiseResult result = newton_on(is_free, terms_, iterate, options);
        best_.result.iterations += result.iterations;
        cancelled_ = cancelled_ || result.reason == StopReason::Cancelled;
    }

    // Outwards or inwards, a little and then farther; true when that has led to a lower equilibrium.
    bool pull(int v, int side)
    {
        std::vector<bool> is_free = around(v);
        for (const double by : {0.35, 0.7}) {
            VectorXd x = best_.iterate.x;
            x.segment<3>(3 * v) += side * by * normal_at(v);
            Iterate trial = iterate_at(terms_, std::move(x));
            is_free[v] = false;
            solve(is_free, trial, held_);
            if (cancelled_ || trial.energy > best_.iterate.energy + barrier) {
                return false;
            }
            is_free[v] = true;
            solve(is_free, trial, free_);
            if (!cancelled_ && is_elsewhere(trial) && follow_up(trial)) {
                return true;
            }
        }
        return false;
    }

    bool is_elsewhere(const Iterate& trial) const
    {
        return (trial.x - best_.iterate.x).lpNorm<Eigen::Infinity>() > new_place &&
               trial.energy < best_.iterate.energy + slack;
    }

    bool follow_up(Iterate& trial)
    {
        const MinimiseResult result = minimise(terms_, trial, options_);
        best_.result.iterations += result.iterations;
        cancelled_ = result.reason == StopReason::Cancelled;
        if (result.reason != StopReason::Converged || trial.energy >= (1 - gain) * best_.iterate.energy ||
            has_collapsed(terms_, trial.x)) {
            return false;
        }
        best_.iterate = std::move(trial);
        return true;
    }

    const EmbeddingTerms& terms_;
    Attempt& best_;
    const MinimiseOptions& options_;
    std::vector<std::vector<int>> neighbours_;
    std::vector<std::vector<HingeVertices>> hinges_; // by their first vertex
    MinimiseOptions held_;
    MinimiseOptions free_;
    bool cancelled_ = false;
};

} // namespace

void lower_equilibrium(const EmbeddingTerms& terms, Attempt& best, const MinimiseOptions& options)
{
    if (best.result.reason == StopReason::Converged && terms.vertex_count <= most_vertices) {
        Search(terms, best, options).run();
    }
}

} // namespace rhombloom
