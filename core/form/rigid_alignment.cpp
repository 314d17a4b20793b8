#include "core/form/rigid_alignment.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace rhombloom {

void align_rigidly(Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& target)
{
    const Eigen::Vector3d from = points.rowwise().mean();
    const Eigen::Vector3d to = target.rowwise().mean();
    const Eigen::Matrix3d covariance = (points.colwise() - from) * (target.colwise() - to).transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d v = svd.matrixV();
    if ((v * svd.matrixU().transpose()).determinant() < 0) {
        v.col(2) *= -1; // a rotation, not a reflection
    }
    const Eigen::Matrix3d rotation = v * svd.matrixU().transpose();
    points = (rotation * (points.colwise() - from)).colwise() + to;
}

} // namespace rhombloom
