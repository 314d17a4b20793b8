#pragma once

#include "core/form/minimise.h"

namespace rhombloom {

//! \brief What became of one start.
struct Attempt
{
    Iterate iterate;
    MinimiseResult result;
};

//! \brief Descend from \p x; a surface that has settled inside out turns over.
Attempt attempt(const EmbeddingTerms& terms, const Eigen::VectorXd& x, const MinimiseOptions& options);

//! \brief In equilibrium and the other not, or else lower.
bool is_better(const Attempt& a, const Attempt& b);

//! \brief In equilibrium, without a dimple, and the guards bear hardly any load.
bool is_good(const EmbeddingTerms& terms, const Attempt& attempt);

//! \brief Has a spring shrunk to next to nothing, or a corner closed? So it goes where there is no guard against it.
bool has_collapsed(const EmbeddingTerms& terms, const Eigen::VectorXd& x);

//! \brief \p other takes the place of \p best if it is better, which is the answer; \p best counts all iterations.
bool keep_better(Attempt& best, Attempt other);

constexpr double dimple_angle = -0.785; //!< radians; a hinge more concave than this is taken for a dimple's rim

} // namespace rhombloom
