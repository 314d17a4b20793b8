#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/form/embedding_terms.h"

//! The problems that the benchmark of the embedding sets, all with the default element.
namespace rhombloom::bench {

//! Positions to start from, in units of la.
struct Start
{
    EmbeddingTerms terms;
    Eigen::VectorXd x;
};

struct Case
{
    std::string name; //!< kind and size or model: "plain-1920", "model-bunny"
    std::function<Start(unsigned seed)> make;
    int repeats = 5;
    double limit_s = 60; //!< per solver and run
    bool rivals = true;
};

//! \details `noise-N`: the join of the subdivided icosahedron with N elements, 0.1 la of noise per coordinate;
//! `plain-N`: the same from the generator's positions; `move-N`: in equilibrium, one vertex moved by 0.3 la (480: the
//! join, 588: checker-588); `torus-600`, `capsule-600`: 0.1 la of noise; `model-NAME`: an example's equilibrium with
//! that noise.
std::vector<Case> cases();

} // namespace rhombloom::bench
