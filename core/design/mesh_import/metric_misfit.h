#pragma once

#include <array>
#include <memory>

#include <Eigen/Core>

#include "core/design/mesh_import/remesh_mesh.h"

namespace rhombloom {

//! \brief Curvature that a flip of an edge moves: what it adds at four vertices, zero in sum.
struct CurvatureChange
{
    std::array<int, 4> vertex{};
    std::array<double, 4> amount{};
};

//! \brief How badly equilateral triangles fit a metric: the sum of u^2 over the vertices, where lengths are off by a
//! factor exp(u), Laplacian(u) = target's curvature minus theirs.
//! \details u is smoothed over the length of an edge: shorter waves buckle away and cost hardly any distance. The
//! Laplacian is that of the mesh when this is made; two sparse factorisations.
class MetricMisfit
{
public:
    //! \param residual the target's curvature minus the mesh's, at each vertex
    MetricMisfit(const EditMesh& mesh, Eigen::VectorXd residual);
    ~MetricMisfit();

    //! \brief The sum of squares.
    double value() const;

    //! \brief By how much the sum grows with \p change, but for the square of the change's own.
    double first_order(const CurvatureChange& change) const;

    //! \brief What \p change does to the sum's gradient.
    Eigen::VectorXd response(const CurvatureChange& change) const;

    //! \brief The square of the change's own.
    static double own_square(const CurvatureChange& change, const Eigen::VectorXd& response);

    void apply(const CurvatureChange& change, const Eigen::VectorXd& response);

private:
    struct Factors;
    Eigen::VectorXd squared(const Eigen::VectorXd& curvature) const;

    std::unique_ptr<Factors> factors_;
    Eigen::VectorXd residual_;
    Eigen::VectorXd pull_; //!< half the sum's gradient by the residual
};

} // namespace rhombloom
