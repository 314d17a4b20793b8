#pragma once

#include <Eigen/Core>

namespace rhombloom {

//! \brief Move \p points (one per column) rigidly to the least-squares best fit with \p target (Kabsch).
//! \details Where the fit leaves the rotation open (all points on a line), the smallest rotation is as good as any.
void align_rigidly(Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& target);

} // namespace rhombloom
