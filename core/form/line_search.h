#pragma once

#include <functional>

#include "core/form/embedding_energy.h"

namespace rhombloom {

//! \brief A point of the minimisation with its energy and gradient, in units of la.
struct Iterate
{
    Eigen::VectorXd x;
    Eigen::VectorXd gradient;
    double energy = 0;

    double gradient_norm() const { return gradient.lpNorm<Eigen::Infinity>(); }
};

Iterate iterate_at(const EmbeddingTerms& terms, Eigen::VectorXd x);

struct LineSearchOptions
{
    double first_step = 1; //!< share of the direction
    double max_move = 2;   //!< la: no vertex moves farther in one step
};

//! \brief Go along \p direction until the energy has decreased enough (Armijo).
//! \details Where the decrease to be expected drowns in roundoff, a smaller gradient counts instead.
//! \return the share of \p direction gone; 0, and nothing moved, when the energy does not decrease.
double line_search(const EmbeddingTerms& terms, Iterate& iterate, const Eigen::VectorXd& direction,
                   const LineSearchOptions& options);

//! \brief The same for another energy, known by its value and gradient at any positions.
double line_search(const std::function<Iterate(Eigen::VectorXd)>& at, Iterate& iterate,
                   const Eigen::VectorXd& direction, const LineSearchOptions& options);

} // namespace rhombloom
