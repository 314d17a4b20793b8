#pragma once

#include <memory>

#include <Eigen/Core>

#include "core/form/embedding_terms.h"

namespace rhombloom {

struct LaplacianWeights
{
    double edge = 1;
    double diagonal = 0; //!< 0: the graph of edges alone
    double shift = 1e-6; //!< added to the diagonal: makes the matrix definite
};

//! \brief The weighted Laplacian of the graph of springs, factored.
//! \details One unknown per vertex, so it costs a small share of the energy's Hessian.
class GraphLaplacian
{
public:
    GraphLaplacian(const EmbeddingTerms& terms, const LaplacianWeights& weights);
    ~GraphLaplacian();

    //! \brief Solve for each column of \p right_sides, one row per vertex.
    Eigen::MatrixX3d solve(const Eigen::MatrixX3d& right_sides) const;

private:
    struct Factor;
    std::unique_ptr<Factor> factor_;
};

} // namespace rhombloom
