#pragma once

#include "exporters/bent_element_hooks.h"

namespace rhombloom {

//! \brief Draws the segments of a bent sheet back to their flat lengths while its points stay near their places.
//! \details Minimises `sum k (|x_i - x_j| - l)^2 + sum a |x - place|^2` by turns: every segment finds its best
//! direction, then all points solve one linear system, the same for all elements and iterations (projective dynamics;
//! Bouaziz et al. 2014). The corners, which lie in the holes, are held by spokes to the holes' rims. Where the whole
//! outline comes out of length all the same, the places hold less, by steps, and the outline's segments are wished
//! shorter.
class SheetRelaxation
{
public:
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3>;

    SheetRelaxation(const FlatSheet& sheet, const Element& element, const HookParameters& parameters,
                    const Hooks& hooks);

    //! \brief \p points (one row each) moved; the corners \p corners stay where they are.
    Rows relaxed(const Rows& points, const std::array<Vec3, 4>& corners) const;

private:
    struct Segment
    {
        int a;
        int b;
        double length;
        double stiffness;
        bool rim;
    };

    //! How much the places hold, and the inverse of the system that follows.
    struct Hold
    {
        Eigen::VectorXd anchors;
        Eigen::MatrixXd inverse;
        int iterations = 0;
        double rim_gain = 0; //!< by which the outline's own length is corrected in each iteration
    };

    Rows relaxed(const Rows& places, const Hold& hold) const;
    double rim_distortion(const Rows& points) const; //!< bent/flat - 1

    std::vector<Segment> segments_;
    std::vector<Hold> holds_; //!< from firm to loose
    int rim_ = 0;             //!< points
    double rim_length_ = 0;   //!< flat, mm
};

} // namespace rhombloom
