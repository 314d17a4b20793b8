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

    double squares(const Eigen::Affine3d& pose) const { return (pose * from - to).squaredNorm(); }
};

class Fitting
{
public:
    Fitting(const Surface& surface, const MeshTree& target)
        : elements_(element_triangles(surface)), target_(target), own_(sample(elements_.mesh(), samples)),
          others_(sample(target.mesh(), samples)), own_hints_(own_.size(), -1), others_hints_(others_.size(), -1)
    {
    }

    //! Iterated closest points of the surface's own points, or of the target's as well.
    Eigen::Affine3d pose(bool rescale, bool both_ways)
    {
        constexpr int rounds = 6;
        Eigen::Affine3d pose = Eigen::Affine3d::Identity();
        for (int i = 0; i < rounds; ++i) {
            const Pairs pairs = this->pairs(pose, both_ways);
            pose.matrix() = Eigen::umeyama(pairs.from, pairs.to, rescale);
        }
        return pose;
    }

    //! Mean square of the distances, both ways.
    double mean_square(const Eigen::Affine3d& pose) { return pairs(pose, true).squares(pose) / (2 * samples); }

private:
    static constexpr int samples = 1500; // of each surface

    Pairs pairs(const Eigen::Affine3d& pose, bool both_ways)
    {
        Pairs result;
        result.from.resize(3, own_.size() + (both_ways ? others_.size() : 0));
        result.to.resize(3, result.from.cols());
        Eigen::Index column = 0;
        for (std::size_t k = 0; k < own_.size(); ++k, ++column) {
            const NearestPoint near = target_.nearest(pose * own_[k], own_hints_[k]);
            own_hints_[k] = near.triangle;
            result.from.col(column) = own_[k];
            result.to.col(column) = near.point;
        }
        const Eigen::Affine3d back = pose.inverse();
        for (std::size_t k = 0; both_ways && k < others_.size(); ++k, ++column) {
            const NearestPoint near = elements_.nearest(back * others_[k], others_hints_[k]);
            others_hints_[k] = near.triangle;
            result.from.col(column) = near.point;
            result.to.col(column) = others_[k];
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

Eigen::Affine3d fit(const Surface& surface, const MeshTree& target, bool rescale)
{
    constexpr double close = 0.02; // of the target's size
    constexpr double clearly = 0.8;
    Fitting fitting(surface, target);
    const Eigen::Affine3d one_way = fitting.pose(rescale, false);
    const double off = fitting.mean_square(one_way);
    if (off < close * close * bounds(target.mesh()).sizes().squaredNorm()) {
        return one_way;
    }
    const Eigen::Affine3d both_ways = fitting.pose(rescale, true);
    return fitting.mean_square(both_ways) < clearly * off ? both_ways : one_way;
}

} // namespace rhombloom
