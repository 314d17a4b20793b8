#pragma once

#include <deque>
#include <functional>

#include <Eigen/Core>

namespace rhombloom {

//! \brief The memory of a quasi-Newton method: the last steps and what they did to the gradient (L-BFGS, Nocedal 1980).
class LimitedMemory
{
public:
    //! \brief Applies the inverse of a first approximation of the Hessian.
    using Seed = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

    explicit LimitedMemory(std::size_t length) : length_(length) {}

    bool empty() const { return corrections_.empty(); }
    void clear() { corrections_.clear(); }

    //! \brief Take note of a step, unless the energy is concave along it; the oldest one is forgotten.
    void remember(Eigen::VectorXd step, Eigen::VectorXd change_of_gradient);

    //! \brief A direction of descent by the two-loop recursion. Without a seed, the last step gives the scale.
    //! \pre A seed, or a memory that is not empty.
    Eigen::VectorXd direction(const Eigen::VectorXd& gradient, const Seed& seed = {}) const;

private:
    struct Correction
    {
        Eigen::VectorXd step;
        Eigen::VectorXd change;
        double curvature;
    };

    std::size_t length_;
    std::deque<Correction> corrections_;
};

} // namespace rhombloom
