#include <algorithm>
#include <map>

#include "core/form/parallel.h"
#include "exporters/bent_element_solid.h"
#include "exporters/draco_mesh.h"
#include "exporters/preview_ghost.h"
#include "exporters/preview_model.h"

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;

constexpr int normal_bits = 8;
//! Beyond this the rim's half millimetre would tilt the normals of narrow tips visibly.
constexpr double expected_within_deg = 60;

//! All elements that look outward with the same face, in one mesh.
DracoMesh merged_mesh(const PreviewModel& model, Outward outward)
{
    DracoMesh mesh;
    const auto triangles = solid_triangles(model.bent.sheet, outward);
    for (std::size_t f = 0; f < model.bent.elements.size(); ++f) {
        const BentElement& e = model.bent.elements[f];
        if (e.outward != outward) {
            continue;
        }
        const int first = static_cast<int>(mesh.points.size());
        const SolidElement solid = solid_element(model.bent, e, model.thickness);
        for (std::size_t i = 0; i < solid.points.size(); ++i) {
            mesh.points.push_back(to_gltf(solid.points[i]));
            mesh.normals.push_back(to_gltf_direction(solid.normals[i]));
            mesh.elements.push_back(static_cast<std::uint16_t>(f));
        }
        for (const auto& t : triangles) {
            mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        }
    }
    return mesh;
}

//! Adds the stream and the accessors that describe it; returns the primitive.
Json add_primitive(Glb& glb, const DracoStream& stream, int material)
{
    const DracoMesh& mesh = stream.decoded;
    const int view = add_view(glb, stream.bytes, ViewTarget::None);
    const int points = add_accessor(glb, -1, Component::Float, "VEC3", mesh.points.size());
    set_bounds(glb, points, mesh.points);
    const int normals = add_accessor(glb, -1, Component::Float, "VEC3", mesh.normals.size());
    const int elements = add_accessor(glb, -1, Component::UInt16, "SCALAR", mesh.elements.size());
    const bool small = mesh.points.size() < 65535;
    const int indices =
        add_accessor(glb, -1, small ? Component::UInt16 : Component::UInt32, "SCALAR", 3 * mesh.triangles.size());
    Json primitive{{"attributes", {{"POSITION", points}, {"NORMAL", normals}, {"_ELEMENT_ID", elements}}},
                   {"indices", indices},
                   {"material", material}};
    primitive["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view},
        {"attributes",
         {{"POSITION", stream.point_id}, {"NORMAL", stream.normal_id}, {"_ELEMENT_ID", stream.element_id}}}};
    return primitive;
}

//! The labels as lists: by face number, but "flipped" holds the faces that are, and "component" says which of
//! "components".
Json label_table(const PreviewModel& model)
{
    Json table{{"components", model.components}, {"flipped", Json::array()}};
    for (std::size_t f = 0; f < model.labels.size(); ++f) {
        const ElementLabel& label = model.labels[f];
        table["names"].push_back(label.name);
        table["steps"].push_back(label.step);
        table["component"].push_back(label.component);
        if (label.facing == Facing::Back) {
            table["flipped"].push_back(f);
        }
    }
    return table;
}

//! The largest distance of a decoded point from the nearest source point of its element.
double decoded_error(const DracoMesh& source, const DracoMesh& decoded)
{
    std::map<int, std::pair<std::size_t, std::size_t>> range;
    for (std::size_t i = 0; i < source.elements.size(); ++i) {
        auto& r = range.try_emplace(source.elements[i], std::pair{i, i}).first->second;
        r.second = i + 1;
    }
    double worst = 0;
    for (std::size_t i = 0; i < decoded.points.size(); ++i) {
        const auto [first, last] = range.at(decoded.elements[i]);
        float nearest = 1e30F;
        for (std::size_t k = first; k < last; ++k) {
            nearest = std::min(nearest, (source.points[k] - decoded.points[i]).squaredNorm());
        }
        worst = std::max(worst, 1000 * std::sqrt(static_cast<double>(nearest)));
    }
    return worst;
}

struct SideStream
{
    Expected<DracoStream> stream;
    double max_error_mm = 0;
};

SideStream compressed_side(DracoMesh mesh, double tolerance_mm)
{
    const PointGrid grid = point_grid(mesh.points, tolerance_mm * 1e-3);
    mesh.normals = expected_normals(mesh, grid, normal_bits, expected_within_deg);
    SideStream side{compress(mesh, grid, normal_bits)};
    side.max_error_mm = side.stream ? decoded_error(mesh, side.stream->decoded) : 0;
    return side;
}

} // namespace

Expected<CompressedPreview> merged_glb(const PreviewModel& model, const PreviewOptions& options)
{
    std::vector<DracoMesh> meshes;
    std::vector<int> materials;
    for (const Outward outward : {Outward::Front, Outward::Back}) {
        DracoMesh mesh = merged_mesh(model, outward);
        if (!mesh.points.empty()) {
            meshes.push_back(std::move(mesh));
            materials.push_back(outward == Outward::Back ? 1 : 0);
        }
    }
    std::vector<SideStream> sides(meshes.size());
    parallel_tasks(default_threads(), static_cast<int>(meshes.size()),
                   [&](int k) { sides[k] = compressed_side(std::move(meshes[k]), options.tolerance_mm); });
    Glb glb = make_glb(model.title);
    glb.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    glb.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    add_materials(glb, options.lamp == LampLook::On);
    CompressedPreview result;
    Json primitives = Json::array();
    for (std::size_t k = 0; k < sides.size(); ++k) {
        if (!sides[k].stream) {
            return tl::make_unexpected(sides[k].stream.error());
        }
        primitives.push_back(add_primitive(glb, *sides[k].stream, materials[k]));
        result.max_error_mm = std::max(result.max_error_mm, sides[k].max_error_mm);
    }
    glb.json["meshes"].push_back({{"primitives", std::move(primitives)}});
    glb.json["nodes"].push_back({{"name", "elements"}, {"mesh", 0}, {"extras", label_table(model)}});
    glb.json["scenes"][0]["nodes"] = {0};
    if (auto ok = add_compressed_ghost(glb, model.ghost); !ok) {
        return tl::make_unexpected(ok.error());
    }
    result.bytes = glb_bytes(glb);
    return result;
}

} // namespace rhombloom
