#pragma once

#include "core/form/newton_system.h"

namespace rhombloom {

//! \brief The hinges of interior_descent(), each with a slack and a force of its own.
//! \details The cost w gamma^2 of a concave hinge is the minimum of w (gamma - s)^2 over slacks s >= 0, and its moment
//! -z, with the force z = 2 w (s - gamma) >= 0 and s z = 0. Here s and z are unknowns, and s z goes to zero gradually.
class ConcaveHinges
{
public:
    ConcaveHinges(const EmbeddingTerms& terms, const Eigen::VectorXd& x, int threads);

    //! \brief The mean size of the angles, radians: the scale of the widths.
    double mean_angle() const { return angle_.abs().mean(); }

    //! \brief The mean product of slack and force: how far it is from being settled which hinges are concave.
    double mean_product() const { return (slack_ * force_).mean(); }

    //! \brief The width of angles over which the hinges are rounded on the central path with that mean.
    double width() const;

    //! \brief Take the point of the central path with \p width for slacks and forces; \p x should be its minimum, see
    //! smoothed_descent().
    void put_on_path(const Eigen::VectorXd& x, double width);

    //! \brief See the hinges at the positions \p x.
    void look(const Eigen::VectorXd& x);

    //! \brief The gradient with the forces instead of the moments of concave hinges.
    Eigen::VectorXd residual(const Iterate& iterate) const;

    //! \brief How the hinges enter the Hessian.
    const std::vector<HingeResponse>& responses();

    //! \brief The direction to residual and gaps of zero for the products of slack and force to become \p target; the
    //! positions' part is returned.
    Eigen::VectorXd direction(const NewtonSystem& system, const Eigen::VectorXd& residual,
                              const Eigen::ArrayXd& target);

    //! \brief Mehrotra's target: the product that the direction to zero leaves, and its second-order error. While the
    //! shape is far from equilibrium, the products do not go ahead of it.
    Eigen::ArrayXd corrected_target(double residual_norm);

    //! \brief The share of the direction that keeps slacks and forces positive.
    double longest_step() const;

    //! \brief Take the step in slacks and forces.
    void advance(double share);

private:
    void round_off(double width);
    void find_angles(const Eigen::VectorXd& x);
    Eigen::VectorXd spread(const Eigen::ArrayXd& values) const;
    Eigen::ArrayXd along(const Eigen::VectorXd& step) const;

    const EmbeddingTerms& terms_;
    int threads_;
    double weight_;
    double first_residual_ = 0;
    double first_product_ = 0;
    std::vector<HingeResponse> responses_;
    Eigen::ArrayXd angle_;
    Eigen::Matrix<double, 12, Eigen::Dynamic> gradients_; // of the angles
    Eigen::ArrayXd slack_, force_, share_, gap_, slack_step_, force_step_;
};

} // namespace rhombloom
