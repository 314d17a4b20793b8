#include "tests/bench/embedding_rivals.h"

#include <ctime>

#include <Eigen/SparseCholesky>
#include <lbfgs.h>

#include "core/form/settle.h"

namespace rhombloom::bench {

namespace {

double processor_time()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

struct LbfgsProblem
{
    const EmbeddingTerms& terms;
    Recorder recorder;
    Eigen::VectorXd x, gradient;
};

lbfgsfloatval_t evaluate(void* instance, const lbfgsfloatval_t* x, lbfgsfloatval_t* g, int n, lbfgsfloatval_t)
{
    auto& problem = *static_cast<LbfgsProblem*>(instance);
    problem.x = Eigen::Map<const Eigen::VectorXd>(x, n);
    const double energy = embedding_gradient(problem.terms, problem.x, problem.gradient).total();
    Eigen::Map<Eigen::VectorXd>(g, n) = problem.gradient;
    return energy;
}

int progress(void* instance, const lbfgsfloatval_t*, const lbfgsfloatval_t* g, lbfgsfloatval_t energy, lbfgsfloatval_t,
             lbfgsfloatval_t, lbfgsfloatval_t, int n, int, int)
{
    auto& problem = *static_cast<LbfgsProblem*>(instance);
    const double norm = Eigen::Map<const Eigen::VectorXd>(g, n).lpNorm<Eigen::Infinity>();
    return norm > 1e-8 && problem.recorder.record(energy, norm) ? 0 : 1;
}

Trace run_liblbfgs(const EmbeddingTerms& terms, const Eigen::VectorXd& start, double limit)
{
    LbfgsProblem problem{terms, Recorder(limit), start, {}};
    lbfgs_parameter_t parameters;
    lbfgs_parameter_init(&parameters);
    parameters.m = 20;
    parameters.epsilon = 0;
    parameters.max_linesearch = 40;
    Eigen::VectorXd x = start;
    double energy = 0;
    lbfgs(static_cast<int>(x.size()), x.data(), &energy, evaluate, progress, &problem, &parameters);
    problem.recorder.record(terms, x);
    return problem.recorder.trace();
}

using SparseMatrix = Eigen::SparseMatrix<double>;

SparseMatrix expand(const BlockMatrix& matrix)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < matrix.size; ++j) {
        for (int k = matrix.start[j]; k < matrix.start[j + 1]; ++k) {
            for (int c = 0; c < 3; ++c) {
                for (int r = 0; r < 3; ++r) {
                    entries.emplace_back(3 * matrix.row[k] + r, 3 * j + c, matrix.value[9 * k + 3 * c + r]);
                }
            }
        }
    }
    SparseMatrix out(3 * matrix.size, 3 * matrix.size);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

// Newton with every term's Hessian made positive semidefinite.
Trace run_projected_newton(const EmbeddingTerms& terms, const Eigen::VectorXd& start, double limit)
{
    Recorder recorder(limit);
    HessianPattern pattern;
    BlockMatrix hessian = hessian_matrix(terms, pattern);
    Eigen::SimplicialLDLT<SparseMatrix> solver;
    solver.analyzePattern(expand(hessian));
    solver.setShift(1e-8);
    Iterate iterate = iterate_at(terms, start);
    while (recorder.record(iterate.energy, iterate.gradient_norm()) && iterate.gradient_norm() > 1e-8) {
        embedding_hessian(terms, pattern, iterate.x, {1}, hessian);
        solver.factorize(expand(hessian));
        if (!line_search(terms, iterate, -solver.solve(iterate.gradient), {1, 2})) {
            break;
        }
    }
    return recorder.trace();
}

} // namespace

Recorder::Recorder(double limit_s) : limit_(limit_s), begin_(processor_time()) {}

bool Recorder::record(double energy, double gradient_norm)
{
    const double now = processor_time() - begin_ - excluded_;
    trace_.push_back({now, energy, gradient_norm});
    return now < limit_;
}

bool Recorder::record(const EmbeddingTerms& terms, const Eigen::VectorXd& x)
{
    const double entered = processor_time();
    const Iterate iterate = iterate_at(terms, x);
    trace_.push_back({entered - begin_ - excluded_, iterate.energy, iterate.gradient_norm()});
    excluded_ += processor_time() - entered;
    return trace_.back().seconds < limit_;
}

Solver ours(int threads)
{
    return {"rhombloom", [threads](const EmbeddingTerms& terms, const Eigen::VectorXd& start, double limit) {
                Recorder recorder(limit);
                MinimiseOptions options;
                options.tolerance = 1e-8;
                options.threads = threads;
                options.progress = [&](int, const Iterate& now) {
                    return recorder.record(now.energy, now.gradient_norm());
                };
                EmbeddingTerms own = terms;
                Eigen::VectorXd x = start;
                settle(own, x, options);
                recorder.record(own, x); // without guards, where the shape stands without them
                return recorder.trace();
            }};
}

Solver liblbfgs()
{
    return {"liblbfgs", run_liblbfgs};
}

Solver projected_newton()
{
    return {"projected Newton, Eigen LDLT", run_projected_newton};
}

} // namespace rhombloom::bench
