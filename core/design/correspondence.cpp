#include "core/design/correspondence.h"

#include <algorithm>
#include <cmath>

namespace rhombloom {

namespace {

constexpr double defect_slack = 1e-9; // radians

//! The shift at which the two closest vertices of the loops meet.
int closest_shift(const Interface& fixed, const Interface& moving)
{
    double best = 1e300;
    int shift = 0;
    for (int i = 0; i < fixed.size(); ++i) {
        for (int j = 0; j < moving.size(); ++j) {
            const double distance = (fixed.points[i] - moving.points[j]).squaredNorm();
            if (distance < best) {
                best = distance;
                shift = (i + j) % fixed.size();
            }
        }
    }
    return shift;
}

} // namespace

int partner(const Correspondence& match, int i, int size)
{
    return (match.shift - i + 2 * size) % size;
}

std::optional<Correspondence> correspondence(const Interface& fixed, const Interface& moving, int shift,
                                             const DefectRange& limits)
{
    const int n = fixed.size();
    Correspondence match{shift, std::min(fixed.zipped_defect, moving.zipped_defect), -1e300};
    for (int i = 0; i < n; ++i) {
        const int j = partner(match, i, n);
        const double defect = two_pi - fixed.angles[i] - moving.angles[j];
        if (!(defect >= limits.min - defect_slack && defect <= limits.max + defect_slack)) {
            return std::nullopt;
        }
        match.min_defect = std::min(match.min_defect, defect);
        match.max_defect = std::max(match.max_defect, defect);
    }
    return match;
}

std::vector<Correspondence> correspondences(const Interface& fixed, const Interface& moving, const DefectRange& limits)
{
    std::vector<Correspondence> result;
    const int n = fixed.size();
    if (n != moving.size()) {
        return result;
    }
    const int first = closest_shift(fixed, moving);
    for (int k = 0; k < n; ++k) {
        if (const auto match = correspondence(fixed, moving, (first + k) % n, limits)) {
            result.push_back(*match);
        }
    }
    return result;
}

Eigen::Isometry3d alignment(const Interface& fixed, const Interface& moving, const Correspondence& match)
{
    const int n = fixed.size();
    Eigen::Matrix3Xd from(3, n);
    Eigen::Matrix3Xd to(3, n);
    for (int i = 0; i < n; ++i) {
        to.col(i) = fixed.points[i];
        from.col(i) = moving.points[partner(match, i, n)];
    }
    Eigen::Isometry3d pose;
    pose.matrix() = Eigen::umeyama(from, to, false);
    return pose;
}

double misfit(const Interface& fixed, const Interface& moving, const Correspondence& match,
              const Eigen::Isometry3d& pose)
{
    const int n = fixed.size();
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        sum += (fixed.points[i] - pose * moving.points[partner(match, i, n)]).squaredNorm();
    }
    return std::sqrt(sum / n);
}

} // namespace rhombloom
