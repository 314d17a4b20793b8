#include "exporters/bent_element_relax.h"

#include <algorithm>
#include <set>

#include <Eigen/Cholesky>

namespace rhombloom {

namespace {

constexpr double core_anchor = 0.02; //!< of points on the element's own sheet
constexpr double hook_anchor = 0.1;  //!< of points laid over the neighbour
constexpr double corner_anchor = 1e7;
constexpr int iterations = 30;

} // namespace

SheetRelaxation::SheetRelaxation(const FlatSheet& sheet, const Element& element, const HookParameters& parameters,
                                 const Hooks& hooks)
{
    std::vector<Vec2> points = sheet.points;
    const std::array<Vec2, 4> corners = flat_corners(element);
    points.insert(points.end(), corners.begin(), corners.end());
    std::set<std::pair<int, int>> pairs;
    for (const auto& t : sheet.triangles) {
        for (int k = 0; k < 3; ++k) {
            pairs.insert(std::minmax(t[k], t[(k + 1) % 3]));
        }
    }
    const int count = static_cast<int>(sheet.points.size());
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < 4; ++k) {
            if ((points[i] - corners[k]).norm() < 1.05 * parameters.hole_radius) {
                pairs.insert({i, count + k});
            }
        }
    }
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count + 4, count + 4);
    for (const auto& [a, b] : pairs) {
        const double length = (points[a] - points[b]).norm();
        const double stiffness = 0.1 * element.la / std::max(length, 0.01 * element.la);
        segments_.push_back({a, b, length, stiffness});
        matrix(a, a) += stiffness;
        matrix(b, b) += stiffness;
        matrix(a, b) -= stiffness;
        matrix(b, a) -= stiffness;
    }
    anchors_ = Eigen::VectorXd::Constant(count + 4, core_anchor);
    for (const HookPoint& h : hooks.points) {
        anchors_(h.point) = core_anchor + h.share * (hook_anchor - core_anchor);
    }
    anchors_.tail<4>().setConstant(corner_anchor);
    matrix.diagonal() += anchors_;
    inverse_ = matrix.llt().solve(Eigen::MatrixXd::Identity(count + 4, count + 4));
}

SheetRelaxation::Rows SheetRelaxation::relaxed(const Rows& points, const std::array<Vec3, 4>& corners) const
{
    Rows places(points.rows() + 4, 3);
    places.topRows(points.rows()) = points;
    for (int k = 0; k < 4; ++k) {
        places.row(points.rows() + k) = corners[k];
    }
    const Rows held = anchors_.asDiagonal() * places;
    Rows x = places;
    for (int iteration = 0; iteration < iterations; ++iteration) {
        Rows right = held;
        for (const Segment& s : segments_) {
            const Eigen::RowVector3d d = x.row(s.a) - x.row(s.b);
            const Eigen::RowVector3d wish = s.stiffness * s.length / std::max(d.norm(), 1e-12) * d;
            right.row(s.a) += wish;
            right.row(s.b) -= wish;
        }
        x.noalias() = inverse_ * right;
    }
    return x.topRows(points.rows());
}

} // namespace rhombloom
