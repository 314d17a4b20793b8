#include "exporters/bent_element_report.h"

#include <algorithm>
#include <cmath>

#include "exporters/bent_element_hooks.h"

namespace rhombloom {

namespace {

struct Segment
{
    int a;
    int b;
    double flat; //!< mm
    bool hook;
};

std::vector<Segment> segments(const FlatSheet& sheet, const Hooks& hooks)
{
    std::vector<bool> hook(sheet.points.size(), false);
    for (const HookPoint& h : hooks.points) {
        hook[h.point] = true;
    }
    std::vector<Segment> list;
    for (const auto& t : sheet.triangles) {
        for (int k = 0; k < 3; ++k) {
            const int a = t[k];
            const int b = t[(k + 1) % 3];
            list.push_back({a, b, (sheet.points[b] - sheet.points[a]).norm(), hook[a] || hook[b]});
        }
    }
    return list;
}

double bow(const Element& element, const BentElement& e, const std::array<Vec3, 4>& c)
{
    const std::array<Vec2, 4> flat = flat_corners(element);
    const Vec3 low = bent_position(e.patch, 0.5 * (flat[0] + flat[1])) - 0.5 * (c[0] + c[1]);
    const Vec3 high = bent_position(e.patch, 0.5 * (flat[2] + flat[3])) - 0.5 * (c[2] + c[3]);
    return 0.5 * (low.norm() + high.norm());
}

double rim_distortion(const FlatSheet& sheet, const BentElement& e, double flat)
{
    double rim = 0;
    for (std::size_t i = 0; i < sheet.rim; ++i) {
        rim += (e.points[(i + 1) % sheet.rim] - e.points[i]).norm();
    }
    return std::abs(rim / flat - 1);
}

void measure_segments(const std::vector<Segment>& list, const BentElement& e, std::vector<double>& all,
                      BendingReport& report)
{
    for (const Segment& s : list) {
        const double distortion = std::abs((e.points[s.b] - e.points[s.a]).norm() / s.flat - 1);
        all.push_back(distortion);
        double& worst = s.hook ? report.max_hook_distortion : report.max_length_distortion;
        worst = std::max(worst, distortion);
    }
}

void measure_corners(const Surface& surface, const Element& element, const BentElement& e, BendingReport& report)
{
    const std::array<Vec2, 4> flat = flat_corners(element);
    std::array<Vec3, 4> corners;
    for (int k = 0; k < 4; ++k) {
        corners[k] = surface.point(Vertex(e.corners[k]));
        const double error = (bent_position(e.patch, flat[k]) - corners[k]).norm();
        report.max_corner_error_mm = std::max(report.max_corner_error_mm, error);
    }
    report.mean_bow_mm += bow(element, e, corners);
}

} // namespace

BendingReport measure_bending(const BentSurface& bent, const Surface& surface, const Element& element,
                              const HookParameters& hooks)
{
    BendingReport report;
    const std::vector<Segment> list = segments(bent.sheet, find_hooks(bent.sheet, element, hooks));
    const double flat = rim_length(bent.sheet);
    std::vector<double> all;
    for (const BentElement& e : bent.elements) {
        measure_segments(list, e, all, report);
        report.max_rim_distortion = std::max(report.max_rim_distortion, rim_distortion(bent.sheet, e, flat));
        measure_corners(surface, element, e, report);
    }
    report.mean_bow_mm /= static_cast<double>(bent.elements.size());
    const auto p99 = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 99 / 100);
    std::nth_element(all.begin(), p99, all.end());
    report.p99_length_distortion = *p99;
    return report;
}

} // namespace rhombloom
