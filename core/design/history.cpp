#include "core/design/history.h"

#include <Eigen/Geometry>

#include "core/model/base_shapes.h"
#include "core/model/validity.h"

namespace rhombloom {

namespace {

Eigen::Isometry3d pose(const Place& place)
{
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.translate(place.position);
    result.rotate(Eigen::AngleAxisd(radians(place.rotation_deg.z()), Vec3::UnitZ()));
    result.rotate(Eigen::AngleAxisd(radians(place.rotation_deg.y()), Vec3::UnitY()));
    result.rotate(Eigen::AngleAxisd(radians(place.rotation_deg.x()), Vec3::UnitX()));
    return result;
}

Expected<Surface> carry_out(const Place& place, const Element& element)
{
    auto shape = base_shape(place.shape, element);
    if (!shape) {
        return tl::make_unexpected(shape.error());
    }
    Surface surface = std::move(shape->surface);
    surface.components = {place.id};
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, pose(place) * surface.point(v));
    }
    return surface;
}

std::string text(const Place& place)
{
    return "place " + place.shape + " as " + place.id;
}

} // namespace

Expected<Replay> replay(const Design& design, const ReplayOptions& options)
{
    Replay result;
    const int count = static_cast<int>(design.operations.size());
    if (count > 1) {
        return refuse("$.operations[1]: a second shape needs a merge, which is not built yet");
    }
    for (int i = 0; i < count; ++i) {
        const Place& place = std::get<Place>(design.operations[i]);
        if (options.progress && !options.progress(i, count, text(place))) {
            return refuse("stopped");
        }
        auto surface = carry_out(place, design.element);
        if (!surface) {
            return refuse("$.operations[" + std::to_string(i) + "]: " + surface.error().message);
        }
        result.embedding = embed(*surface, design.element, options.embedding);
        result.stages.push_back({text(place), *surface});
        result.surface = std::move(*surface);
    }
    return result;
}

} // namespace rhombloom
