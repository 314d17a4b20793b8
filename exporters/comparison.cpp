#include "exporters/comparison.h"

#include <algorithm>

namespace rhombloom {

namespace {

//! A mesh in the form of one bent element, so that it is lit like the others.
BentSurface as_one_element(const TriangleMesh& mesh)
{
    BentSurface result;
    result.sheet.triangles = mesh.triangles;
    BentElement whole;
    whole.points = mesh.points;
    whole.normals.assign(mesh.points.size(), Vec3::Zero());
    for (const Triangle& t : mesh.triangles) {
        for (const int v : t) {
            whole.normals[v] += area_normal(mesh, t);
        }
    }
    for (Vec3& normal : whole.normals) {
        normal = normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::UnitZ());
    }
    result.elements.push_back(std::move(whole));
    return result;
}

Picture side_by_side(const Picture& left, const Picture& right)
{
    Picture result{left.width + right.width, left.height, {}};
    for (int y = 0; y < left.height; ++y) {
        for (const Picture* part : {&left, &right}) {
            const auto row = part->rgba.begin() + static_cast<std::ptrdiff_t>(4) * part->width * y;
            result.rgba.insert(result.rgba.end(), row, row + static_cast<std::ptrdiff_t>(4) * part->width);
        }
    }
    return result;
}

} // namespace

Expected<std::string> comparison_png(const BentSurface& bent, const TriangleMesh& target, const PictureOptions& options)
{
    std::vector<Vec3> points = target.points;
    for (const BentElement& e : bent.elements) {
        points.insert(points.end(), e.points.begin(), e.points.end());
    }
    PictureOptions shared = options;
    shared.camera = fitted_camera(points, options);
    const Expected<Picture> right = picture(bent, shared);
    if (!right) {
        return tl::make_unexpected(right.error());
    }
    shared.tint = Eigen::Vector3f::Constant(0.42F);
    const Expected<Picture> left = picture(as_one_element(target), shared);
    if (!left) {
        return tl::make_unexpected(left.error());
    }
    return png_of(side_by_side(*left, *right));
}

Expected<std::string> comparison_png(const Surface& surface, const Element& element, const TriangleMesh& target,
                                     const PictureOptions& options)
{
    const Expected<BentSurface> bent = bent_surface(surface, element);
    if (!bent) {
        return tl::make_unexpected(bent.error());
    }
    return comparison_png(*bent, target, options);
}

} // namespace rhombloom
