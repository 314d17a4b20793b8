#include "core/design/pose.h"

#include <numeric>

#include <Eigen/Geometry>

namespace rhombloom {

EmbedReport embed_in_place(Surface& surface, const Surface& before, const std::vector<int>& number,
                           const Element& element, const EmbedOptions& options)
{
    const EmbedReport report = embed(surface, element, options);
    std::vector<std::pair<Vec3, Vec3>> pairs;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] >= 0) {
            pairs.emplace_back(surface.point(Vertex(number[v])), before.point(Vertex(static_cast<int>(v))));
        }
    }
    if (pairs.size() < 3) {
        return report;
    }
    Eigen::Matrix3Xd from(3, pairs.size());
    Eigen::Matrix3Xd to(3, pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        from.col(i) = pairs[i].first;
        to.col(i) = pairs[i].second;
    }
    Eigen::Isometry3d back;
    back.matrix() = Eigen::umeyama(from, to, false);
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, back * surface.point(v));
    }
    return report;
}

EmbedReport embed_in_place(Surface& surface, const Element& element, const EmbedOptions& options)
{
    const Surface before = surface;
    std::vector<int> number(surface.n_vertices());
    std::iota(number.begin(), number.end(), 0);
    return embed_in_place(surface, before, number, element, options);
}

Vec3 middle(const Surface& surface, const std::vector<Vertex>& vertices)
{
    Vec3 sum = Vec3::Zero();
    for (const Vertex v : vertices) {
        sum += surface.point(v);
    }
    return sum / static_cast<double>(vertices.size());
}

bool settled(const EmbedReport& report)
{
    constexpr double largest_stretch = 0.02;
    return report.converged && report.max_stretch <= largest_stretch;
}

} // namespace rhombloom
