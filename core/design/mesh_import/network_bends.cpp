#include "core/design/mesh_import/network_bends.h"

#include <cmath>
#include <set>

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace rhombloom {

namespace {

std::vector<std::set<int>> neighbours(const TriangleMesh& mesh)
{
    std::vector<std::set<int>> result(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            result[t[k]].insert({t[(k + 1) % 3], t[(k + 2) % 3]});
        }
    }
    return result;
}

//! The columns less their mean.
Eigen::Matrix3Xd centred(Eigen::Matrix3Xd points)
{
    points.colwise() -= Vec3(points.rowwise().mean());
    return points;
}

Eigen::Matrix3Xd columns(const std::vector<Vec3>& points, const std::vector<int>& which)
{
    Eigen::Matrix3Xd result(3, which.size());
    for (std::size_t k = 0; k < which.size(); ++k) {
        result.col(static_cast<Eigen::Index>(k)) = points[which[k]];
    }
    return result;
}

//! The rotation that brings the columns nearest to others, about their means.
Eigen::Matrix3d rotation(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to)
{
    const Eigen::Matrix3d moment = centred(to) * from.transpose();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vec3 signs = Vec3::Ones();
    signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1; // no mirror image
    return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

} // namespace

std::vector<Eigen::Matrix3d> turns(const TriangleMesh& settled, const std::vector<Vec3>& meant)
{
    expects(settled.points.size() == meant.size(), "turns: a place for each corner");
    const std::vector<std::set<int>> ring = neighbours(settled);
    std::vector<Eigen::Matrix3d> result;
    for (const std::set<int>& around : ring) {
        std::set<int> near = around;
        for (const int w : around) {
            near.insert(ring[w].begin(), ring[w].end());
        }
        const std::vector<int> which(near.begin(), near.end());
        result.push_back(rotation(columns(meant, which), columns(settled.points, which)));
    }
    return result;
}

Strayed astray(const std::vector<Vec3>& settled, const std::vector<Vec3>& meant, bool rescale)
{
    expects(settled.size() == meant.size(), "astray: a place for each point");
    using Points = Eigen::Map<const Eigen::Matrix3Xd>;
    const auto count = static_cast<Eigen::Index>(meant.size());
    const Points from(settled.front().data(), 3, count);
    const Points to(meant.front().data(), 3, count);
    Strayed result;
    result.pose.matrix() = Eigen::umeyama(from, to, rescale);
    result.rms = std::sqrt((result.pose * from - to).squaredNorm() / static_cast<double>(count));
    return result;
}

} // namespace rhombloom
