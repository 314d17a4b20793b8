#include "core/design/mesh_import/mesh_distance.h"

#include <algorithm>
#include <cmath>

namespace rhombloom {

namespace {

Deviation deviation(const std::vector<Vec3>& points, const MeshTree& tree)
{
    Deviation result;
    int last = -1; // the samples of a triangle follow each other
    for (const Vec3& p : points) {
        const NearestPoint nearest = tree.nearest(p, last);
        const double d = nearest.distance;
        last = nearest.triangle;
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

//! Points of either surface and what is nearest to them on the other.
struct Pairs
{
    Eigen::Matrix3Xd from; //!< on the surface that is moved
    Eigen::Matrix3Xd to;

    Deviation deviation(const Eigen::Affine3d& pose) const
    {
        const Eigen::VectorXd squares = (pose * from - to).colwise().squaredNorm();
        return {std::sqrt(squares.mean()), std::sqrt(squares.maxCoeff())};
    }
};

class Fitting
{
public:
    Fitting(const Surface& surface, const MeshTree& target)
        : elements_(element_triangles(surface)), target_(target), own_(sample(elements_.mesh(), samples)),
          others_(sample(target.mesh(), samples)), own_hints_(own_.size(), -1), others_hints_(others_.size(), -1)
    {
    }

    //! Iterated closest points of some of the surface's own points, or of the target's as well.
    Eigen::Affine3d pose(bool rescale, bool both_ways)
    {
        constexpr int rounds = 6;
        constexpr double little = 1e-4; // of the size
        constexpr std::size_t every = 3;
        Eigen::Affine3d pose = Eigen::Affine3d::Identity();
        for (int i = 0; i < rounds; ++i) {
            Pairs pairs = own_pairs(pose, every);
            if (both_ways) {
                const Pairs others = others_pairs(pose, every);
                pairs.from.conservativeResize(3, pairs.from.cols() + others.from.cols());
                pairs.to.conservativeResize(3, pairs.from.cols());
                pairs.from.rightCols(others.from.cols()) = others.from;
                pairs.to.rightCols(others.to.cols()) = others.to;
            }
            const Eigen::Affine3d before = pose;
            pose.matrix() = Eigen::umeyama(pairs.from, pairs.to, rescale);
            const Eigen::Matrix3Xd moved = pose * pairs.from - before * pairs.from;
            if (moved.colwise().squaredNorm().mean() < little * little * squared_size_of_target()) {
                break;
            }
        }
        return pose;
    }

    Distance distance(const Eigen::Affine3d& pose)
    {
        return {own_pairs(pose, 1).deviation(pose), others_pairs(pose, 1).deviation(pose)};
    }

    double squared_size_of_target() const { return bounds(target_.mesh()).sizes().squaredNorm(); }

private:
    static constexpr int samples = 1500; // of each surface

    static Pairs pairs(std::size_t points, std::size_t every)
    {
        const auto count = static_cast<Eigen::Index>((points + every - 1) / every);
        return {Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count)};
    }

    Pairs own_pairs(const Eigen::Affine3d& pose, std::size_t every)
    {
        Pairs result = pairs(own_.size(), every);
        for (std::size_t k = 0; k < own_.size(); k += every) {
            const NearestPoint near = target_.nearest(pose * own_[k], own_hints_[k]);
            own_hints_[k] = near.triangle;
            result.from.col(static_cast<Eigen::Index>(k / every)) = own_[k];
            result.to.col(static_cast<Eigen::Index>(k / every)) = near.point;
        }
        return result;
    }

    Pairs others_pairs(const Eigen::Affine3d& pose, std::size_t every)
    {
        Pairs result = pairs(others_.size(), every);
        const Eigen::Affine3d back = pose.inverse();
        for (std::size_t k = 0; k < others_.size(); k += every) {
            const NearestPoint near = elements_.nearest(back * others_[k], others_hints_[k]);
            others_hints_[k] = near.triangle;
            result.from.col(static_cast<Eigen::Index>(k / every)) = near.point;
            result.to.col(static_cast<Eigen::Index>(k / every)) = others_[k];
        }
        return result;
    }

    MeshTree elements_;
    const MeshTree& target_;
    std::vector<Vec3> own_;
    std::vector<Vec3> others_;
    std::vector<int> own_hints_; //!< triangles of the other surface that were nearest last
    std::vector<int> others_hints_;
};

} // namespace

Fit fit(const Surface& surface, const MeshTree& target, bool rescale)
{
    constexpr double close = 0.02; // of the target's size
    constexpr double clearly = 0.9;
    Fitting fitting(surface, target);
    const auto fitted = [&](bool both_ways) {
        const Eigen::Affine3d pose = fitting.pose(rescale, both_ways);
        return Fit{pose, fitting.distance(pose)};
    };
    const Fit one_way = fitted(false);
    if (one_way.distance.rms() < close * std::sqrt(fitting.squared_size_of_target())) {
        return one_way;
    }
    const Fit both_ways = fitted(true);
    return both_ways.distance.rms() < clearly * one_way.distance.rms() ? both_ways : one_way;
}

} // namespace rhombloom
