#include "exporters/bending_modes.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace rhombloom {

namespace {

using Points = Eigen::Matrix3Xd;

Points matrix_of(const std::vector<Vec3>& points)
{
    Points m(3, static_cast<int>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
        m.col(static_cast<int>(i)) = points[i];
    }
    return m;
}

//! The pose that lays \p shape onto \p points best: rotation for elements that look outward with their front, rotation
//! and reflection for the others (Kabsch).
BentPose aligned(const Points& shape, const Points& points, Outward outward)
{
    const Vec3 from = shape.rowwise().mean();
    const Vec3 to = points.rowwise().mean();
    const Eigen::Matrix3d h = (points.colwise() - to) * (shape.colwise() - from).transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(h, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vec3 flip = Vec3::Ones();
    flip.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() * sign(outward) > 0 ? 1 : -1;
    BentPose pose;
    pose.axes = svd.matrixU() * flip.asDiagonal() * svd.matrixV().transpose();
    pose.origin = to - pose.axes * from;
    return pose;
}

Points inside(const BentPose& pose, const Points& points)
{
    return pose.axes.transpose() * (points.colwise() - pose.origin);
}

Eigen::Map<const Eigen::VectorXd> flat(const Points& points)
{
    return {points.data(), points.size()};
}

double largest_distance(const Eigen::MatrixXd& residual)
{
    double worst = 0;
    for (int c = 0; c < residual.cols(); ++c) {
        for (int i = 0; i < residual.rows(); i += 3) {
            worst = std::max(worst, residual.col(c).segment<3>(i).squaredNorm());
        }
    }
    return std::sqrt(worst);
}

} // namespace

BendingModes aligned_elements(const BentSurface& bent)
{
    std::vector<Points> shapes;
    for (const BentElement& e : bent.elements) {
        shapes.push_back(matrix_of(e.points));
    }
    BendingModes result;
    result.poses.resize(shapes.size());
    Points mean = shapes.front();
    if (bent.elements.front().outward == Outward::Back) {
        mean.row(2) *= -1;
    }
    for (int round = 0; round < 3; ++round) {
        mean.colwise() -= mean.rowwise().mean().eval();
        Points sum = Points::Zero(3, mean.cols());
        for (std::size_t f = 0; f < shapes.size(); ++f) {
            result.poses[f] = aligned(mean, shapes[f], bent.elements[f].outward);
            sum += inside(result.poses[f], shapes[f]);
        }
        mean = sum / static_cast<double>(shapes.size());
    }
    result.mean = flat(mean);
    return result;
}

Eigen::MatrixXd principal_directions(const Eigen::MatrixXd& data, int count)
{
    const int wanted = std::min<int>(count + 8, static_cast<int>(std::min(data.rows(), data.cols())));
    Eigen::MatrixXd q(data.rows(), wanted);
    for (int k = 0; k < wanted; ++k) {
        q.col(k) = data.col(static_cast<int>(static_cast<long>(k) * data.cols() / wanted));
        q(k, k) += 1e-6;
    }
    for (int iteration = 0; iteration < 12; ++iteration) {
        const Eigen::HouseholderQR<Eigen::MatrixXd> qr(q);
        const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(data.rows(), wanted);
        q.noalias() = data * (data.transpose() * basis);
    }
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(q);
    const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(data.rows(), wanted);
    const Eigen::MatrixXd small = basis.transpose() * data;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(small * small.transpose());
    return (basis * solver.eigenvectors().rowwise().reverse()).leftCols(std::min(count, wanted));
}

BendingModes bending_modes(const BentSurface& bent, double tolerance_mm, int most)
{
    BendingModes result = aligned_elements(bent);
    Eigen::MatrixXd residual(result.mean.size(), static_cast<int>(bent.elements.size()));
    for (std::size_t f = 0; f < bent.elements.size(); ++f) {
        const Points points = matrix_of(bent.elements[f].points);
        residual.col(static_cast<int>(f)) = flat(inside(result.poses[f], points)) - result.mean;
    }
    const Eigen::MatrixXd directions = principal_directions(residual, most);
    const Eigen::MatrixXd weights = directions.transpose() * residual;
    int count = 0;
    for (; count < directions.cols() && largest_distance(residual) > tolerance_mm; ++count) {
        residual.noalias() -= directions.col(count) * weights.row(count);
    }
    result.modes = directions.leftCols(count);
    for (std::size_t f = 0; f < bent.elements.size(); ++f) {
        result.poses[f].weights = weights.col(static_cast<int>(f)).head(count);
    }
    return result;
}

std::vector<Vec3> reconstructed(const BendingModes& modes, const BentPose& pose)
{
    Eigen::VectorXd shape = modes.mean;
    shape.noalias() += modes.modes * pose.weights;
    std::vector<Vec3> points;
    for (int i = 0; i < shape.size(); i += 3) {
        points.push_back(pose.origin + pose.axes * shape.segment<3>(i));
    }
    return points;
}

double error_mm(const BendingModes& modes, const BentSurface& bent)
{
    double worst = 0;
    for (std::size_t f = 0; f < bent.elements.size(); ++f) {
        const std::vector<Vec3> points = reconstructed(modes, modes.poses[f]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            worst = std::max(worst, (points[i] - bent.elements[f].points[i]).norm());
        }
    }
    return worst;
}

} // namespace rhombloom
