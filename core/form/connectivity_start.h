#pragma once

#include "core/form/attempt.h"

namespace rhombloom {

//! \brief Do the positions \p x say nothing of the shape: are neighbours no nearer to each other than any two vertices?
bool knows_nothing(const EmbeddingTerms& terms, const Eigen::VectorXd& x);

//! \brief Is every part of the surface far from equilibrium? One that was edited or merged is so at its seams only.
bool is_disordered(const EmbeddingTerms& terms, const Eigen::VectorXd& x);

//! \brief Is the surface small enough for attempt_from_connectivity()? Its layouts take a time and a memory of n^2.
bool has_layouts(const EmbeddingTerms& terms);

//! \brief The lowest of several shapes found from the connectivity alone: layouts by the distances along the surface
//! (distance_layout()), blown up with several pressures (inflate()), and their folds refilled.
//! \details Always the same for the same surface. Ends early when the lowest one has been found twice.
Attempt attempt_from_connectivity(const EmbeddingTerms& terms, const MinimiseOptions& options);

//! \brief Take regions with folds out and blow new ones up in their place, wider and wider, while \p best improves.
void refill_folds(const EmbeddingTerms& terms, Attempt& best, const MinimiseOptions& options);

} // namespace rhombloom
