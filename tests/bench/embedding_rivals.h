#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/form/minimise.h"

//! General solvers on the energy that rhombloom's own one minimises, with the same vectorised energy and gradient where
//! they can use it.
namespace rhombloom::bench {

//! What a solver had reached after how much processor time.
struct Sample
{
    double seconds = 0;
    double energy = 0; //!< in units of la
    double gradient_norm = 0;
};

using Trace = std::vector<Sample>;

//! Records samples, and says when the time is up.
class Recorder
{
public:
    explicit Recorder(double limit_s);

    //! False when the limit is reached. Time spent in here does not count.
    bool record(double energy, double gradient_norm);
    bool record(const EmbeddingTerms& terms, const Eigen::VectorXd& x);

    const Trace& trace() const { return trace_; }

private:
    double limit_;
    double begin_;
    double excluded_ = 0;
    Trace trace_;
};

struct Solver
{
    std::string name;
    std::function<Trace(const EmbeddingTerms&, const Eigen::VectorXd& start, double limit_s)> run;
};

Solver ours(int threads = 1);
Solver liblbfgs();
Solver projected_newton();
Solver ceres_levenberg_marquardt();
Solver ceres_dogleg();

} // namespace rhombloom::bench
