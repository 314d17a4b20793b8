#include "exporters/bent_element_solid.h"

#include <Eigen/Geometry>

namespace rhombloom {

namespace {

//! Away from the sheet at rim point \p i: across the rim's direction, in the sheet.
Vec3 rim_direction(const BentSurface& bent, const BentElement& e, std::size_t i)
{
    const std::size_t n = bent.sheet.rim;
    const Vec3 along = e.points[(i + 1) % n] - e.points[(i + n - 1) % n];
    return along.cross(e.normals[i]).normalized() * sign(e.outward);
}

} // namespace

SolidElement solid_element(const BentSurface& bent, const BentElement& element, double thickness)
{
    constexpr double lean = 0.12;
    SolidElement solid;
    for (const double side : {1.0, -1.0}) {
        for (std::size_t i = 0; i < element.points.size(); ++i) {
            Vec3 normal = side * element.normals[i];
            solid.points.push_back(element.points[i] + 0.5 * thickness * normal);
            normal.normalize();
            if (i < bent.sheet.rim) {
                normal = (normal + lean * rim_direction(bent, element, i)).normalized();
            }
            solid.normals.push_back(normal);
        }
    }
    return solid;
}

std::vector<std::array<int, 3>> solid_triangles(const FlatSheet& sheet, Outward outward)
{
    const int n = static_cast<int>(sheet.points.size());
    const int rim = static_cast<int>(sheet.rim);
    std::vector<std::array<int, 3>> triangles;
    // The rim first, with diagonals along the way round: from there Draco foresees points best (2 % of the bytes).
    for (int i = 0; i < rim; ++i) {
        const int j = (i + 1) % rim;
        triangles.push_back({i, n + i, j});
        triangles.push_back({j, n + i, n + j});
    }
    for (const auto& t : sheet.triangles) {
        triangles.push_back(t);
        triangles.push_back({n + t[2], n + t[1], n + t[0]});
    }
    if (outward == Outward::Back) {
        for (auto& t : triangles) {
            std::swap(t[0], t[1]);
        }
    }
    return triangles;
}

} // namespace rhombloom
