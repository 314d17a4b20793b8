#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/form/parallel.h"
#include "exporters/bent_element_solid.h"
#include "exporters/draco_mesh.h"
#include "exporters/preview_model.h"

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;

constexpr int normal_bits = 8;
//! Beyond this the rim's half millimetre would tilt the normals of narrow tips visibly.
constexpr double expected_within_deg = 60;

//! The elements of the parts: equal shares of a side, so that threads have equal work.
std::vector<std::vector<int>> shares(const PreviewModel& model)
{
    constexpr std::size_t most = 96;
    std::vector<std::vector<int>> result;
    for (const Outward outward : {Outward::Front, Outward::Back}) {
        std::vector<int> side;
        for (std::size_t f = 0; f < model.bent.elements.size(); ++f) {
            if (model.bent.elements[f].outward == outward) {
                side.push_back(static_cast<int>(f));
            }
        }
        const std::size_t count = (side.size() + most - 1) / most;
        for (std::size_t k = 0; k < count; ++k) {
            const auto at = [&](std::size_t part) {
                return side.begin() + static_cast<std::ptrdiff_t>(part * side.size() / count);
            };
            result.emplace_back(at(k), at(k + 1));
        }
    }
    return result;
}

//! Elements that look outward with the same face, in one mesh.
DracoMesh merged_mesh(const PreviewModel& model, const std::vector<int>& faces)
{
    DracoMesh mesh;
    const auto triangles = solid_triangles(model.bent.sheet, model.bent.elements[faces.front()].outward);
    for (const int f : faces) {
        const int first = static_cast<int>(mesh.points.size());
        const SolidElement solid = solid_element(model.bent, model.bent.elements[f], model.thickness);
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

Expected<MergedPart> compressed_part(const PreviewModel& model, const std::vector<int>& faces, double tolerance_mm)
{
    MergedPart part;
    part.outward = model.bent.elements[faces.front()].outward;
    part.mesh = merged_mesh(model, faces);
    part.grid = point_grid(part.mesh.points, tolerance_mm * 1e-3);
    part.mesh.normals = expected_normals(part.mesh, part.grid, normal_bits, expected_within_deg);
    return compress(part.mesh, part.grid, normal_bits).map([&](DracoStream stream) {
        part.stream = std::move(stream);
        return std::move(part);
    });
}

//! Adds the stream and the accessors that describe it; returns the primitive.
Json add_primitive(Glb& glb, const MergedPart& part)
{
    const DracoMesh& mesh = part.mesh;
    const DracoStream& stream = part.stream;
    const int view = add_view(glb, stream.bytes, ViewTarget::None);
    const int points = add_accessor(glb, -1, Component::Float, "VEC3", mesh.points.size());
    set_bounds(glb, points, on_grid(mesh.points, part.grid));
    const int normals = add_accessor(glb, -1, Component::Float, "VEC3", mesh.normals.size());
    const int elements = add_accessor(glb, -1, Component::UInt16, "SCALAR", mesh.elements.size());
    const bool small = mesh.points.size() < 65535;
    const int indices =
        add_accessor(glb, -1, small ? Component::UInt16 : Component::UInt32, "SCALAR", 3 * mesh.triangles.size());
    Json primitive{{"attributes", {{"POSITION", points}, {"NORMAL", normals}, {"_ELEMENT_ID", elements}}},
                   {"indices", indices},
                   {"material", part.outward == Outward::Back ? 1 : 0}};
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

using Points = std::vector<Eigen::Vector3f>;

//! The distance of \p p from the nearest of \p points, which ascend in x.
double nearest(const Points& points, const Eigen::Vector3f& p)
{
    const auto from = std::lower_bound(points.begin(), points.end(), p.x(),
                                       [](const Eigen::Vector3f& q, float x) { return q.x() < x; });
    float best = 1e30F;
    const auto near = [&](const Eigen::Vector3f& q) {
        best = std::min(best, (q - p).squaredNorm());
        return (q.x() - p.x()) * (q.x() - p.x()) < best;
    };
    for (auto q = from; q != points.end() && near(*q); ++q) {
    }
    for (auto q = from; q != points.begin() && near(*std::prev(q)); --q) {
    }
    return std::sqrt(static_cast<double>(best));
}

//! The largest distance of a decoded point from the nearest point of its element, or the other way round.
double largest_distance(const DracoMesh& from, const DracoMesh& to)
{
    std::map<int, Points> by_element;
    for (std::size_t i = 0; i < to.points.size(); ++i) {
        by_element[to.elements[i]].push_back(to.points[i]);
    }
    for (auto& [element, points] : by_element) {
        std::sort(points.begin(), points.end(),
                  [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) { return a.x() < b.x(); });
    }
    double worst = 0;
    for (std::size_t i = 0; i < from.points.size(); ++i) {
        worst = std::max(worst, nearest(by_element[from.elements[i]], from.points[i]));
    }
    return worst;
}

Expected<double> part_error_mm(const MergedPart& part)
{
    const Expected<DracoMesh> decoded = decompress(part.stream);
    if (!decoded) {
        return tl::make_unexpected(decoded.error());
    }
    if (decoded->points.size() != part.mesh.points.size() || decoded->triangles.size() != part.mesh.triangles.size()) {
        return machine_failure("the preview's mesh reads back with " + std::to_string(decoded->points.size()) +
                               " points instead of " + std::to_string(part.mesh.points.size()));
    }
    return 1000 * std::max(largest_distance(*decoded, part.mesh), largest_distance(part.mesh, *decoded));
}

//! \p task of every index at once; the first refusal, if there is one.
template <class Value>
Expected<std::vector<Value>> all_of(std::size_t count, const std::function<Expected<Value>(std::size_t)>& task)
{
    std::vector<Expected<Value>> made(count);
    parallel_tasks(default_threads(), static_cast<int>(count), [&](int k) { made[k] = task(k); });
    std::vector<Value> values;
    for (Expected<Value>& value : made) {
        if (!value) {
            return tl::make_unexpected(value.error());
        }
        values.push_back(std::move(*value));
    }
    return values;
}

} // namespace

Expected<MergedPreview> encoded_merged(const PreviewModel& model, const PreviewOptions& options)
{
    const std::vector<std::vector<int>> faces = shares(model);
    Expected<std::vector<MergedPart>> parts = all_of<MergedPart>(
        faces.size(), [&](std::size_t k) { return compressed_part(model, faces[k], options.tolerance_mm); });
    if (!parts) {
        return tl::make_unexpected(parts.error());
    }
    Glb glb = make_glb(model.title);
    glb.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    glb.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    add_materials(glb, options.lamp == LampLook::On);
    Json primitives = Json::array();
    for (const MergedPart& part : *parts) {
        primitives.push_back(add_primitive(glb, part));
    }
    glb.json["meshes"].push_back({{"primitives", std::move(primitives)}});
    glb.json["nodes"].push_back({{"name", "elements"}, {"mesh", 0}, {"extras", label_table(model)}});
    glb.json["scenes"][0]["nodes"] = {0};
    return MergedPreview{glb_bytes(glb), std::move(*parts)};
}

Expected<double> decoded_error_mm(const std::vector<MergedPart>& parts)
{
    return all_of<double>(parts.size(), [&](std::size_t k) { return part_error_mm(parts[k]); })
        .map([](const std::vector<double>& errors) { return *std::max_element(errors.begin(), errors.end()); });
}

Expected<CompressedPreview> merged_glb(const PreviewModel& model, const PreviewOptions& options)
{
    Expected<MergedPreview> merged = encoded_merged(model, options);
    if (!merged) {
        return tl::make_unexpected(merged.error());
    }
    return decoded_error_mm(merged->parts).map([&](double error) {
        return CompressedPreview{std::move(merged->bytes), error, 0};
    });
}

} // namespace rhombloom
