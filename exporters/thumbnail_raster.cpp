#include "exporters/thumbnail_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombloom {

namespace {

//! Calls \p visit(sample index, depth, barycentric weights) for the samples of one triangle.
template <class Visit>
void scan(const std::array<Vec3, 3>& p, int width, int height, const Visit& visit)
{
    const double area = (p[1].x() - p[0].x()) * (p[2].y() - p[0].y()) - (p[1].y() - p[0].y()) * (p[2].x() - p[0].x());
    if (std::abs(area) < 1e-12) {
        return;
    }
    const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto [low, high] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    const int x0 = std::max(0, static_cast<int>(std::ceil(left - 0.5)));
    const int x1 = std::min(width - 1, static_cast<int>(std::floor(right - 0.5)));
    const int y0 = std::max(0, static_cast<int>(std::ceil(low - 0.5)));
    const int y1 = std::min(height - 1, static_cast<int>(std::floor(high - 0.5)));
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const double sx = x + 0.5;
            const double sy = y + 0.5;
            const double b1 =
                ((sx - p[0].x()) * (p[2].y() - p[0].y()) - (sy - p[0].y()) * (p[2].x() - p[0].x())) / area;
            const double b2 =
                ((p[1].x() - p[0].x()) * (sy - p[0].y()) - (p[1].y() - p[0].y()) * (sx - p[0].x())) / area;
            const double b0 = 1 - b1 - b2;
            if (b0 >= 0 && b1 >= 0 && b2 >= 0) {
                const double depth = b0 * p[0].z() + b1 * p[1].z() + b2 * p[2].z();
                visit(static_cast<std::size_t>(y) * width + x, static_cast<float>(depth), Vec3(b0, b1, b2));
            }
        }
    }
}

Samples empty_samples(int width, int height)
{
    const auto count = static_cast<std::size_t>(width) * height;
    Samples s;
    s.width = width;
    s.height = height;
    s.depth.assign(count, std::numeric_limits<float>::infinity());
    s.normal.assign(count, Eigen::Vector3f::Zero());
    s.element.assign(count, -1);
    s.sheets.assign(count, 0);
    return s;
}

std::array<Vec3, 3> corners(const std::vector<Vec3>& points, const std::array<int, 3>& t)
{
    return {points[t[0]], points[t[1]], points[t[2]]};
}

} // namespace

Vec3 Projection::operator()(const Vec3& p) const
{
    const Vec3 r = p - camera.eye;
    const double depth = -r.dot(camera.back);
    const double half = camera.tangent > 0 ? camera.tangent * depth : extent;
    const double scale = 0.5 * height / half;
    return {0.5 * width + r.dot(camera.right) * scale, 0.5 * height - r.dot(camera.up) * scale, depth};
}

Vec3 Projection::unproject(double x, double y, double depth) const
{
    const double half = camera.tangent > 0 ? camera.tangent * depth : extent;
    const double scale = half / (0.5 * height);
    return camera.eye + camera.right * ((x - 0.5 * width) * scale) + camera.up * ((0.5 * height - y) * scale) -
           camera.back * depth;
}

Samples rasterise(const RasterScene& scene, const Projection& projection, double sheet_range_mm)
{
    std::vector<Vec3> projected;
    projected.reserve(scene.points.size());
    for (const Vec3& p : scene.points) {
        projected.push_back(projection(p));
    }
    Samples s = empty_samples(projection.width, projection.height);
    for (std::size_t f = 0; f < scene.triangles.size(); ++f) {
        const auto& t = scene.triangles[f];
        scan(corners(projected, t), s.width, s.height, [&](std::size_t i, float depth, const Vec3& b) {
            if (depth < s.depth[i]) {
                s.depth[i] = depth;
                s.element[i] = scene.elements[f];
                const Vec3 n = b[0] * scene.normals[t[0]] + b[1] * scene.normals[t[1]] + b[2] * scene.normals[t[2]];
                s.normal[i] = n.normalized().cast<float>();
            }
        });
    }
    for (const auto& t : scene.triangles) {
        scan(corners(projected, t), s.width, s.height, [&](std::size_t i, float depth, const Vec3&) {
            s.sheets[i] += depth < s.depth[i] + sheet_range_mm && s.sheets[i] < 8 ? 1 : 0;
        });
    }
    return s;
}

} // namespace rhombloom
