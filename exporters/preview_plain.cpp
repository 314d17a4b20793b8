#include "exporters/bent_element_solid.h"
#include "exporters/preview_ghost.h"
#include "exporters/preview_model.h"

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;

Vec3 middle(const std::vector<Vec3>& points)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) {
        sum += p;
    }
    return sum / static_cast<double>(points.size());
}

//! The element's mesh about \p origin.
int add_element_mesh(Glb& glb, const SolidElement& solid, const Vec3& origin, int indices, int material)
{
    std::vector<Eigen::Vector3f> points;
    std::vector<Eigen::Vector3f> normals;
    for (std::size_t i = 0; i < solid.points.size(); ++i) {
        points.push_back(to_gltf(solid.points[i] - origin));
        normals.push_back(to_gltf_direction(solid.normals[i]));
    }
    Json attributes{{"POSITION", add_points(glb, points)}, {"NORMAL", add_normals(glb, normals)}};
    Json primitive{{"attributes", std::move(attributes)}, {"indices", indices}, {"material", material}};
    glb.json["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
    return static_cast<int>(glb.json["meshes"].size()) - 1;
}

} // namespace

std::string plain_glb(const PreviewModel& model, const PreviewOptions& options)
{
    Glb glb = make_glb(model.title);
    add_materials(glb, options.lamp == LampLook::On);
    std::array<int, 2> indices = {-1, -1};
    for (std::size_t f = 0; f < model.labels.size(); ++f) {
        const BentElement& e = model.bent.elements[f];
        const int side = e.outward == Outward::Back ? 1 : 0;
        if (indices[side] < 0) {
            indices[side] = add_indices(glb, solid_triangles(model.bent.sheet, e.outward));
        }
        const Vec3 origin = middle(e.points);
        const SolidElement solid = solid_element(model.bent, e, model.thickness);
        const int mesh = add_element_mesh(glb, solid, origin, indices[side], side);
        const Eigen::Vector3f t = to_gltf(origin);
        glb.json["scenes"][0]["nodes"].push_back(f);
        glb.json["nodes"].push_back({{"name", model.labels[f].name},
                                     {"mesh", mesh},
                                     {"translation", {short_float(t.x()), short_float(t.y()), short_float(t.z())}},
                                     {"extras", label_extras(model, model.labels[f])}});
    }
    if (options.target) {
        add_plain_ghost(glb, *options.target);
    }
    return glb_bytes(glb);
}

} // namespace rhombloom
