#pragma once

#include <vector>

#include "core/form/embedding_energy.h"

namespace rhombloom {

//! \brief Blow up the part of the surface that \p is_free like a foil balloon: springs stretch hardly at all but
//! shorten easily, and a pressure from inside drives the vertices outwards. \details What is turned inside out - a limb
//! pushed into the body, a tube with its inner side out - collapses under the pressure, passes through itself and comes
//! out the right way. Repairs positions that have the right neighbours in about the right places, such as those of
//! distance_layout(), but not the right side out everywhere. \param pressure la per pass and area of la^2 in the
//! beginning; it fades to nothing.
void inflate(const EmbeddingTerms& terms, const std::vector<bool>& is_free, double pressure, Eigen::VectorXd& x);

//! \brief Forget where the vertices that are \p is_free were and stretch a film over their rim instead.
void stretch_film(const EmbeddingTerms& terms, const std::vector<bool>& is_free, Eigen::VectorXd& x);

} // namespace rhombloom
