#include "core/design/reference.h"

#include <cmath>
#include <tuple>

namespace rhombloom {

namespace {

//! Smaller is a better answer. Rounded, so that equals stay equal under rounding errors and the lower number wins.
std::pair<long, long> distance(const Reference& reference, const Vec3& p, const Vec3& middle)
{
    if (reference.kind == Reference::Kind::Near) {
        return {std::lround((p - reference.point).norm() * 1e3), 0};
    }
    const Vec3 out = p - middle;
    const double cosine = out.dot(reference.point) / std::max(1e-12, out.norm() * reference.point.norm());
    return {-std::lround(cosine * 1e4), -std::lround(out.norm())};
}

int nearest(const Reference& reference, const std::vector<Vec3>& points)
{
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : points) {
        middle += p / static_cast<double>(points.size());
    }
    int best = 0;
    for (int i = 1; i < static_cast<int>(points.size()); ++i) {
        if (distance(reference, points[i], middle) < distance(reference, points[best], middle)) {
            best = i;
        }
    }
    return best;
}

Expected<int> find(const Reference& reference, const std::vector<Vec3>& points, const std::string& kind)
{
    if (reference.kind != Reference::Kind::Number) {
        return nearest(reference, points);
    }
    if (reference.number < 0 || reference.number >= static_cast<int>(points.size())) {
        return refuse("there is no " + kind + " " + std::to_string(reference.number) + ": the part has " +
                      std::to_string(points.size()) + ", numbered from 0");
    }
    return reference.number;
}

} // namespace

Expected<Vertex> find_vertex(const Surface& surface, const Reference& reference)
{
    std::vector<Vec3> points;
    for (const Vertex v : surface.vertices()) {
        points.push_back(surface.point(v));
    }
    return find(reference, points, "vertex").map([](int v) { return Vertex(v); });
}

Expected<Face> find_element(const Surface& surface, const Reference& reference)
{
    std::vector<Vec3> points;
    for (const Face f : surface.faces()) {
        points.push_back(centre(surface, f));
    }
    return find(reference, points, "element").map([](int f) { return Face(f); });
}

Vec3 centre(const Surface& surface, Face f)
{
    Vec3 sum = Vec3::Zero();
    for (const Vertex v : surface.fv_range(f)) {
        sum += surface.point(v);
    }
    return sum / 4;
}

} // namespace rhombloom
