#include "exporters/bent_element_relax.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <Eigen/Cholesky>

namespace rhombloom {

namespace {

constexpr double core_anchor = 0.02; //!< of points on the element's own sheet
constexpr double hook_anchor = 0.1;  //!< of points laid over the neighbour
constexpr double corner_anchor = 1e7;
constexpr int iterations = 30;
constexpr std::array<double, 4> looser = {1, 0.3, 0.1, 0.03}; //!< of the anchors
constexpr double rim_gain = 0.3;    //!< rims' segments are wished shorter by so much of what the outline is too long
constexpr double rim_limit = 0.008; //!< |bent/flat - 1| of the outline that is left alone

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
        const bool rim = b < static_cast<int>(sheet.rim) && (b - a == 1 || b - a == static_cast<int>(sheet.rim) - 1);
        segments_.push_back({a, b, length, stiffness, rim});
        matrix(a, a) += stiffness;
        matrix(b, b) += stiffness;
        matrix(a, b) -= stiffness;
        matrix(b, a) -= stiffness;
    }
    Eigen::VectorXd anchors = Eigen::VectorXd::Constant(count, core_anchor);
    for (const HookPoint& h : hooks.points) {
        anchors(h.point) = core_anchor + h.share * (hook_anchor - core_anchor);
    }
    for (const double share : looser) {
        Hold hold;
        hold.iterations = share < 1 ? 2 * iterations : iterations;
        hold.rim_gain = share < 1 ? rim_gain : 0;
        hold.anchors.resize(count + 4);
        hold.anchors << share * anchors, Eigen::Vector4d::Constant(corner_anchor);
        Eigen::MatrixXd held = matrix;
        held.diagonal() += hold.anchors;
        hold.inverse = held.llt().solve(Eigen::MatrixXd::Identity(count + 4, count + 4));
        holds_.push_back(std::move(hold));
    }
    rim_ = static_cast<int>(sheet.rim);
    rim_length_ = rim_length(sheet);
}

double SheetRelaxation::rim_distortion(const Rows& points) const
{
    double length = 0;
    for (int i = 0; i < rim_; ++i) {
        length += (points.row((i + 1) % rim_) - points.row(i)).norm();
    }
    return length / rim_length_ - 1;
}

SheetRelaxation::Rows SheetRelaxation::relaxed(const Rows& points, const std::array<Vec3, 4>& corners) const
{
    Rows places(points.rows() + 4, 3);
    places.topRows(points.rows()) = points;
    for (int k = 0; k < 4; ++k) {
        places.row(points.rows() + k) = corners[k];
    }
    Rows x;
    for (const Hold& hold : holds_) {
        x = relaxed(places, hold);
        if (std::abs(rim_distortion(x)) < rim_limit) {
            break;
        }
    }
    return x.topRows(points.rows());
}

SheetRelaxation::Rows SheetRelaxation::relaxed(const Rows& places, const Hold& hold) const
{
    const Rows held = hold.anchors.asDiagonal() * places;
    Rows x = places;
    double rim_share = 1;
    for (int iteration = 0; iteration < hold.iterations; ++iteration) {
        Rows right = held;
        for (const Segment& s : segments_) {
            const Eigen::RowVector3d d = x.row(s.a) - x.row(s.b);
            const double length = (s.rim ? rim_share : 1) * s.length;
            const Eigen::RowVector3d wish = s.stiffness * length / std::max(d.norm(), 1e-12) * d;
            right.row(s.a) += wish;
            right.row(s.b) -= wish;
        }
        x.noalias() = hold.inverse * right;
        if (hold.rim_gain > 0) {
            const double off = rim_distortion(x);
            const double too_much = off - std::clamp(off, -0.5 * rim_limit, 0.5 * rim_limit);
            rim_share = std::clamp(rim_share - hold.rim_gain * too_much, 0.95, 1.05);
        }
    }
    return x;
}

} // namespace rhombloom
