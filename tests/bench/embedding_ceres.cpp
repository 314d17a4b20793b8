#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/embedding_rivals.h"

namespace rhombloom::bench {

namespace {

using Eigen::Map;
using Eigen::Vector3d;

void put_row(double* jacobian, const Vector3d& row)
{
    std::copy_n(row.data(), 3, jacobian);
}

// Ceres minimises half the sum of squares, hence the factor 2 under the roots.
class SpringResidual : public ceres::SizedCostFunction<4, 3, 3>
{
public:
    SpringResidual(const SpringPair& pair, const SpringLaw& law) : pair_(pair), law_(law) {}

    bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override
    {
        const Vector3d difference = Map<const Vector3d>(x[1]) - Map<const Vector3d>(x[0]);
        const double length = difference.norm();
        const Vector3d u = difference / std::max(length, 1e-12);
        for (int k = 0; k < 2; ++k) {
            const double change = length - pair_.rest[k];
            const double weight = change > 0 ? law_.stretched_weight : law_.compressed_weight;
            put(k, std::sqrt(2 * weight * pair_.inverse_rest[k]), change, u, residuals, jacobians);
            const double excess = std::min(0.0, length - law_.barrier_ratio * pair_.rest[k]);
            put(2 + k, excess < 0 ? std::sqrt(2 * law_.barrier_weight * pair_.inverse_rest[k]) : 0, excess, u,
                residuals, jacobians);
        }
        return true;
    }

private:
    static void put(int row, double root, double change, const Vector3d& u, double* residuals, double** jacobians)
    {
        residuals[row] = root * change;
        for (int end = 0; jacobians != nullptr && end < 2; ++end) {
            if (jacobians[end] != nullptr) {
                Map<Vector3d>(jacobians[end] + 3 * row) = (end == 0 ? -root : root) * u;
            }
        }
    }

    const SpringPair& pair_;
    const SpringLaw& law_;
};

class HingeResidual : public ceres::SizedCostFunction<2, 3, 3, 3, 3>
{
public:
    explicit HingeResidual(const HingeLaw& law) : law_(law) {}

    bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override
    {
        const HingePoints points{Map<const Vector3d>(x[0]), Map<const Vector3d>(x[1]), Map<const Vector3d>(x[2]),
                                 Map<const Vector3d>(x[3])};
        const double angle = hinge_angle(points);
        const double root = std::sqrt(2 * law_.concavity_weight * (angle < 0 ? 1 : law_.convex_weight));
        const double excess = std::max(0.0, angle - law_.ridge_start);
        const double ridge = excess > 0 ? std::sqrt(2 * ridge_weight(law_)) : 0;
        residuals[0] = root * angle;
        residuals[1] = ridge * excess;
        if (jacobians == nullptr) {
            return true;
        }
        const bool active = root != 0 || ridge != 0;
        const Eigen::Matrix<double, 12, 1> gradient =
            active ? hinge_angle_gradient(points) : Eigen::Matrix<double, 12, 1>::Zero().eval();
        for (int k = 0; k < 4; ++k) {
            if (jacobians[k] != nullptr) {
                put_row(jacobians[k], root * gradient.segment<3>(3 * k));
                put_row(jacobians[k] + 3, ridge * gradient.segment<3>(3 * k));
            }
        }
        return true;
    }

private:
    const HingeLaw& law_;
};

class Watch : public ceres::IterationCallback
{
public:
    Watch(Recorder& recorder, const EmbeddingTerms& terms, const Eigen::VectorXd& x)
        : recorder_(recorder), terms_(terms), x_(x)
    {
    }

    ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override
    {
        const bool go_on = recorder_.record(terms_, x_) && recorder_.trace().back().gradient_norm > 1e-8;
        return go_on ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }

private:
    Recorder& recorder_;
    const EmbeddingTerms& terms_;
    const Eigen::VectorXd& x_;
};

void add_terms(ceres::Problem& problem, const EmbeddingTerms& terms, Eigen::VectorXd& x)
{
    const auto at = [&](int v) { return x.data() + 3 * v; };
    for (const SpringPair& pair : terms.springs) {
        problem.AddResidualBlock(new SpringResidual(pair, terms.spring_law), nullptr, at(pair.a), at(pair.b));
    }
    for (const HingeVertices& h : terms.hinges) {
        problem.AddResidualBlock(new HingeResidual(terms.hinge_law), nullptr, at(h[0]), at(h[1]), at(h[2]), at(h[3]));
    }
}

Trace run_ceres(const EmbeddingTerms& terms, const Eigen::VectorXd& start, double limit,
                ceres::TrustRegionStrategyType strategy)
{
    Recorder recorder(limit);
    Eigen::VectorXd x = start;
    ceres::Problem problem;
    add_terms(problem, terms, x);
    Watch watch(recorder, terms, x);
    ceres::Solver::Options options;
    options.trust_region_strategy_type = strategy;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
    options.num_threads = 1;
    options.max_num_iterations = 100000;
    options.function_tolerance = 0;
    options.gradient_tolerance = 1e-8;
    options.parameter_tolerance = 0;
    options.logging_type = ceres::SILENT;
    options.update_state_every_iteration = true;
    options.callbacks = {&watch};
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return recorder.trace();
}

} // namespace

Solver ceres_levenberg_marquardt()
{
    return {"Ceres LM", [](const EmbeddingTerms& terms, const Eigen::VectorXd& start, double limit) {
                return run_ceres(terms, start, limit, ceres::LEVENBERG_MARQUARDT);
            }};
}

Solver ceres_dogleg()
{
    return {"Ceres dogleg", [](const EmbeddingTerms& terms, const Eigen::VectorXd& start, double limit) {
                return run_ceres(terms, start, limit, ceres::DOGLEG);
            }};
}

} // namespace rhombloom::bench
