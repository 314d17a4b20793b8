#include "core/design/mesh_import/mesh_distance.h"

#include <algorithm>
#include <cmath>

namespace rhombloom {

namespace {

Deviation deviation(const std::vector<Vec3>& points, const MeshTree& tree)
{
    Deviation result;
    for (const Vec3& p : points) {
        const double d = tree.nearest(p).distance;
        result.rms += d * d;
        result.max = std::max(result.max, d);
    }
    result.rms = std::sqrt(result.rms / static_cast<double>(std::max<std::size_t>(points.size(), 1)));
    return result;
}

} // namespace

double Distance::rms() const
{
    return std::sqrt((to_target.rms * to_target.rms + from_target.rms * from_target.rms) / 2);
}

TriangleMesh element_triangles(const Surface& surface)
{
    TriangleMesh result;
    for (const Vertex v : surface.vertices()) {
        result.points.push_back(surface.point(v));
    }
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        const int middle = static_cast<int>(result.points.size());
        Vec3 sum = Vec3::Zero();
        for (int k = 0; k < 4; ++k) {
            sum += result.points[q[k]];
            result.triangles.push_back({q[k], q[(k + 1) % 4], middle});
        }
        result.points.emplace_back(sum / 4);
    }
    return result;
}

std::vector<Vec3> sample(const TriangleMesh& mesh, int count)
{
    std::vector<Vec3> result;
    const double step = area(mesh) / count;
    double passed = step / 2;
    unsigned number = 0;
    for (const Triangle& t : mesh.triangles) {
        passed += area_normal(mesh, t).norm() / 2;
        for (; passed >= step && step > 0; passed -= step) {
            // A low-discrepancy sequence (Roberts 2018) folded into the triangle.
            ++number;
            double u = std::fmod(0.7548776662466927 * number, 1.0);
            double v = std::fmod(0.5698402909980532 * number, 1.0);
            if (u + v > 1) {
                u = 1 - u;
                v = 1 - v;
            }
            const Vec3& a = mesh.points[t[0]];
            result.push_back(a + u * (mesh.points[t[1]] - a) + v * (mesh.points[t[2]] - a));
        }
    }
    return result;
}

Distance distance(const Surface& surface, const MeshTree& target, int samples)
{
    const TriangleMesh elements = element_triangles(surface);
    Distance result;
    result.to_target = deviation(sample(elements, samples), target);
    result.from_target = deviation(sample(target.mesh(), samples), MeshTree(elements));
    return result;
}

namespace {

constexpr int fit_rounds = 6;
constexpr int fit_samples = 1500; // of each surface

Eigen::Affine3d fit_points(const std::vector<Vec3>& points, const MeshTree& target, bool rescale)
{
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    Eigen::Matrix3Xd from(3, points.size());
    Eigen::Matrix3Xd to(3, points.size());
    for (int i = 0; i < fit_rounds; ++i) {
        for (std::size_t k = 0; k < points.size(); ++k) {
            from.col(k) = points[k];
            to.col(k) = target.nearest(pose * points[k]).point;
        }
        pose.matrix() = Eigen::umeyama(from, to, rescale);
    }
    return pose;
}

//! Points of either surface and what is nearest to them on the other.
struct Pairs
{
    Eigen::Matrix3Xd from; //!< on the surface that is moved
    Eigen::Matrix3Xd to;

    double squares(const Eigen::Affine3d& pose) const { return (pose * from - to).squaredNorm(); }
};

Pairs pairs_at(const Eigen::Affine3d& pose, const MeshTree& moved, const MeshTree& target)
{
    const std::vector<Vec3> own = sample(moved.mesh(), fit_samples);
    const std::vector<Vec3> others = sample(target.mesh(), fit_samples);
    Pairs result;
    result.from.resize(3, own.size() + others.size());
    result.to.resize(3, result.from.cols());
    Eigen::Index column = 0;
    for (const Vec3& p : own) {
        result.from.col(column) = p;
        result.to.col(column++) = target.nearest(pose * p).point;
    }
    const Eigen::Affine3d back = pose.inverse();
    for (const Vec3& p : others) {
        result.from.col(column) = moved.nearest(back * p).point;
        result.to.col(column++) = p;
    }
    return result;
}

Eigen::Affine3d fit_both(const MeshTree& moved, const MeshTree& target, bool rescale)
{
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    for (int i = 0; i < fit_rounds; ++i) {
        const Pairs pairs = pairs_at(pose, moved, target);
        pose.matrix() = Eigen::umeyama(pairs.from, pairs.to, rescale);
    }
    return pose;
}

} // namespace

Eigen::Affine3d fit(const Surface& surface, const MeshTree& target, bool rescale)
{
    constexpr double close = 0.02; // of the target's size
    constexpr double clearly = 0.8;
    const MeshTree elements(element_triangles(surface));
    const auto squares = [&](const Eigen::Affine3d& pose) { return pairs_at(pose, elements, target).squares(pose); };
    const Eigen::Affine3d one_way = fit_points(sample(elements.mesh(), fit_samples), target, rescale);
    const double one_way_squares = squares(one_way);
    if (one_way_squares < 2 * fit_samples * (close * close * bounds(target.mesh()).sizes().squaredNorm())) {
        return one_way;
    }
    const Eigen::Affine3d both_ways = fit_both(elements, target, rescale);
    return squares(both_ways) < clearly * one_way_squares ? both_ways : one_way;
}

} // namespace rhombloom
