#include "exporters/camera.h"

#include <algorithm>
#include <cmath>

namespace rhombloom {

Vec2 project(const Camera& camera, const Vec3& p)
{
    const Vec3 x = camera.scale * (p - camera.look_at);
    return {x.dot(camera.view.right), -x.dot(camera.view.up)};
}

double depth(const Camera& camera, const Vec3& p)
{
    return (p - camera.look_at).dot(camera.view.toward);
}

Matrix34 page_matrix(const Camera& camera, const Vec2& centre, double page_height)
{
    Matrix34 m;
    m.row(0).head<3>() = camera.scale * camera.view.right;
    m.row(1).head<3>() = camera.scale * camera.view.up;
    m.row(2).head<3>() = camera.view.toward;
    m.col(3) = -m.leftCols<3>() * camera.look_at;
    m(0, 3) += centre.x();
    m(1, 3) += page_height - centre.y();
    return m;
}

Turn turn_between(int from_view, int to_view)
{
    const auto height = [](int view) { return degrees(std::asin(viewpoints()[view].toward.z())); };
    // The eye moving to the right is the model turning to the left.
    int steps = (from_view - to_view) % azimuth_count;
    steps += steps > azimuth_count / 2 ? -azimuth_count : steps < -(azimuth_count - 1) / 2 ? azimuth_count : 0;
    return {std::round(360.0 * steps / azimuth_count), std::round(height(to_view) - height(from_view))};
}

Camera fitted_camera(const Surface& surface, const std::vector<Face>& faces, const std::vector<int>& views,
                     const Vec2& half)
{
    std::vector<Vec3> points;
    for (const Face f : faces) {
        for (const int v : quad(surface, f)) {
            points.push_back(surface.point(Vertex(v)));
        }
    }
    Vec3 low = Vec3::Constant(1e300);
    Vec3 high = Vec3::Constant(-1e300);
    for (const Vec3& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    Camera camera{viewpoints().front(), (low + high) / 2, 1};
    Vec2 reach = Vec2::Constant(1e-9);
    for (const int view : views) {
        camera.view = viewpoints()[view];
        for (const Vec3& p : points) {
            reach = reach.cwiseMax(project(camera, p).cwiseAbs());
        }
    }
    camera.scale = half.cwiseQuotient(reach).minCoeff();
    return camera;
}

} // namespace rhombloom
