#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "exporters/mesh_formats.h"

namespace rhombloom {

using nlohmann::json;

namespace {

constexpr int deepest = 64; // nodes inside nodes

struct Glb
{
    json document;
    std::string_view binary;
};

//! Bytes (signed and not), shorts (signed and not), 32 bit integers, floats.
std::size_t component_bytes(int component)
{
    return component == 5126 || component == 5125 ? 4 : component == 5123 || component == 5122 ? 2 : 1;
}

//! One accessor: where its values stand in the binary chunk.
struct Accessor
{
    const char* first = nullptr;
    std::size_t stride = 0;
    std::size_t count = 0;
    int component = 0; //!< glTF's number of the component type
    bool normalised = false;
};

std::uint32_t word(std::string_view bytes, std::size_t at, int size = 4)
{
    std::uint32_t value = 0;
    for (int k = size - 1; k >= 0; --k) {
        value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
    }
    return value;
}

Expected<Glb> open_glb(std::string_view bytes)
{
    if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF" || word(bytes, 4) != 2) {
        return refuse("the file is no GLB of version 2");
    }
    Glb glb;
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
        const std::size_t length = word(bytes, at);
        const std::uint32_t kind = word(bytes, at + 4);
        if (length > bytes.size() - at - 8) {
            return refuse("the file is cut short: a chunk of " + std::to_string(length) + " bytes is announced, " +
                          std::to_string(bytes.size() - at - 8) + " are left");
        }
        const std::string_view chunk = bytes.substr(at + 8, length);
        if (kind == 0x4E4F534A) {
            glb.document = json::parse(chunk.begin(), chunk.end(), nullptr, false);
        } else if (kind == 0x004E4942) {
            glb.binary = chunk;
        }
        at += 8 + length;
    }
    if (!glb.document.is_object()) {
        return refuse("the file has no readable JSON chunk");
    }
    return glb;
}

//! document[list][index], or null when there is no such thing.
const json& entry(const json& document, const char* list, const json& index)
{
    static const json nothing;
    if (!index.is_number_unsigned() || !document.contains(list) || !document[list].is_array()) {
        return nothing;
    }
    const auto number = index.get<std::size_t>();
    return number < document[list].size() ? document[list][number] : nothing;
}

std::size_t size_at(const json& object, const char* key, std::size_t fallback)
{
    const auto found = object.find(key);
    return found != object.end() && found->is_number_unsigned() ? found->get<std::size_t>() : fallback;
}

Expected<Accessor> accessor(const Glb& glb, const json& index, std::size_t components)
{
    const json& description = entry(glb.document, "accessors", index);
    const json& view = description.is_object() && description.contains("bufferView")
                           ? entry(glb.document, "bufferViews", description["bufferView"])
                           : json();
    if (!view.is_object() || size_at(view, "buffer", 0) != 0 || description.contains("sparse")) {
        return refuse("a mesh's data are not in the file itself or compressed: expected a plain GLB");
    }
    Accessor result;
    result.component = static_cast<int>(size_at(description, "componentType", 0));
    const std::size_t width = component_bytes(result.component);
    result.normalised = description.value("normalized", json(false)) == true;
    result.count = size_at(description, "count", 0);
    result.stride = size_at(view, "byteStride", width * components);
    const std::size_t begin = size_at(view, "byteOffset", 0);
    const std::size_t length = size_at(view, "byteLength", 0);
    const std::size_t offset = size_at(description, "byteOffset", 0);
    const std::size_t last = width * components;
    const bool inside = begin <= glb.binary.size() && length <= glb.binary.size() - begin && offset <= length &&
                        result.stride >= last &&
                        (result.count == 0 ||
                         (length - offset >= last && (length - offset - last) / result.stride >= result.count - 1));
    if (!inside) {
        return refuse("a mesh's data lie outside the file: it is cut short or damaged");
    }
    result.first = glb.binary.data() + begin + offset;
    return result;
}

//! A component as a number; integers as KHR_mesh_quantization has them, from -1 to 1 where they are normalised.
double component_value(std::string_view bytes, const Accessor& data)
{
    const auto raw = word(bytes, 0, static_cast<int>(bytes.size()));
    const auto scaled = [&](double value, double largest) {
        return data.normalised ? std::max(-1.0, value / largest) : value;
    };
    switch (data.component) {
    case 5120:
        return scaled(static_cast<std::int8_t>(raw), 127);
    case 5121:
        return scaled(raw, 255);
    case 5122:
        return scaled(static_cast<std::int16_t>(raw), 32767);
    case 5123:
        return scaled(raw, 65535);
    default:
        return std::bit_cast<float>(raw);
    }
}

Expected<std::vector<Vec3>> positions(const Glb& glb, const json& index)
{
    const auto data = accessor(glb, index, 3);
    if (!data) {
        return tl::make_unexpected(data.error());
    }
    if (data->component != 5126 && (data->component < 5120 || data->component > 5123)) {
        return refuse("the points of a mesh are neither floats nor short integers: expected a plain GLB");
    }
    const std::size_t width = component_bytes(data->component);
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < data->count; ++i) {
        Vec3 p;
        for (int k = 0; k < 3; ++k) {
            p[k] = component_value({data->first + i * data->stride + k * width, width}, *data);
        }
        result.push_back(p);
    }
    return result;
}

Expected<std::vector<int>> indices(const Glb& glb, const json& primitive, std::size_t points)
{
    std::vector<int> result;
    if (!primitive.contains("indices")) {
        for (std::size_t i = 0; i < points; ++i) {
            result.push_back(static_cast<int>(i));
        }
        return result;
    }
    const auto data = accessor(glb, primitive["indices"], 1);
    if (!data) {
        return tl::make_unexpected(data.error());
    }
    const int width = static_cast<int>(component_bytes(data->component));
    for (std::size_t i = 0; i < data->count; ++i) {
        const std::uint32_t index = word(std::string_view(data->first + i * data->stride, width), 0, width);
        if (index >= points) {
            return refuse("a triangle uses point " + std::to_string(index) + ", but its mesh has " +
                          std::to_string(points));
        }
        result.push_back(static_cast<int>(index));
    }
    return result;
}

//! Triangles, strips and fans; lines and points are left out.
void add_triangles(const std::vector<int>& corners, std::size_t mode, int first, TriangleMesh& mesh)
{
    const auto add = [&](int a, int b, int c) { mesh.triangles.push_back({first + a, first + b, first + c}); };
    const std::size_t step = mode == 4 ? 3 : 1;
    if (mode < 4 || mode > 6) {
        return;
    }
    for (std::size_t k = 2; k < corners.size(); k += step) {
        if (mode == 6) {
            add(corners[0], corners[k - 1], corners[k]);
        } else if (mode == 5 && k % 2 == 1) {
            add(corners[k - 1], corners[k - 2], corners[k]);
        } else {
            add(corners[k - 2], corners[k - 1], corners[k]);
        }
    }
}

Expected<void> add_primitive(const Glb& glb, const json& primitive, const Eigen::Affine3d& pose, TriangleMesh& mesh)
{
    if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].is_object() ||
        !primitive["attributes"].contains("POSITION")) {
        return {};
    }
    const auto points = positions(glb, primitive["attributes"]["POSITION"]);
    if (!points) {
        return tl::make_unexpected(points.error());
    }
    const auto corners = indices(glb, primitive, points->size());
    if (!corners) {
        return tl::make_unexpected(corners.error());
    }
    const int first = static_cast<int>(mesh.points.size());
    for (const Vec3& p : *points) {
        mesh.points.push_back(pose * p);
    }
    add_triangles(*corners, size_at(primitive, "mode", 4), first, mesh);
    return {};
}

//! The numbers of a list, or the fallback when it is not a list of as many numbers.
template <std::size_t N>
std::array<double, N> numbers(const json& object, const char* key, std::array<double, N> fallback)
{
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array() || found->size() != N) {
        return fallback;
    }
    for (std::size_t k = 0; k < N; ++k) {
        fallback[k] = (*found)[k].is_number() ? (*found)[k].template get<double>() : fallback[k];
    }
    return fallback;
}

Eigen::Affine3d node_pose(const json& node)
{
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    if (node.contains("matrix")) {
        const auto m = numbers<16>(node, "matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
        for (int k = 0; k < 12; ++k) {
            pose.matrix()(k % 3, k / 3) = m[4 * (k / 3) + k % 3];
        }
        return pose;
    }
    const auto t = numbers<3>(node, "translation", {0, 0, 0});
    const auto r = numbers<4>(node, "rotation", {0, 0, 0, 1});
    const auto s = numbers<3>(node, "scale", {1, 1, 1});
    const Eigen::Quaterniond turn(r[3], r[0], r[1], r[2]);
    pose.translate(Vec3(t[0], t[1], t[2]));
    pose.rotate(turn.norm() > 0 ? turn.normalized() : Eigen::Quaterniond::Identity());
    pose.scale(Vec3(s[0], s[1], s[2]));
    return pose;
}

Expected<void> add_node(const Glb& glb, const json& index, const Eigen::Affine3d& parent, int depth, TriangleMesh& mesh)
{
    constexpr std::size_t most_points = 50'000'000;
    const json& node = entry(glb.document, "nodes", index);
    if (!node.is_object()) {
        return {};
    }
    if (depth > deepest || mesh.points.size() > most_points) {
        return refuse("the scene's nodes contain each other or repeat their meshes without end");
    }
    if (node.contains("extensions") && node["extensions"].contains("EXT_mesh_gpu_instancing")) {
        return refuse("a mesh is repeated by EXT_mesh_gpu_instancing: expected a plain GLB");
    }
    const Eigen::Affine3d pose = parent * node_pose(node);
    if (node.contains("mesh")) {
        const json& shape = entry(glb.document, "meshes", node["mesh"]);
        if (shape.is_object() && shape.contains("primitives") && shape["primitives"].is_array()) {
            for (const json& primitive : shape["primitives"]) {
                if (auto ok = add_primitive(glb, primitive, pose, mesh); !ok) {
                    return ok;
                }
            }
        }
    }
    if (node.contains("children") && node["children"].is_array()) {
        for (const json& child : node["children"]) {
            if (auto ok = add_node(glb, child, pose, depth + 1, mesh); !ok) {
                return ok;
            }
        }
    }
    return {};
}

//! The nodes to start from: the scene's, or all that are nobody's child.
json roots(const json& document)
{
    const json scene = document.contains("scene") ? document["scene"] : json(0U);
    const json& chosen = entry(document, "scenes", scene);
    if (chosen.is_object() && chosen.contains("nodes") && chosen["nodes"].is_array()) {
        return chosen["nodes"];
    }
    json all = json::array();
    const std::size_t count = document.contains("nodes") && document["nodes"].is_array() ? document["nodes"].size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        all.push_back(i);
    }
    return all;
}

} // namespace

Expected<MeshFile> read_glb(std::string_view bytes)
{
    const auto glb = open_glb(bytes);
    if (!glb) {
        return tl::make_unexpected(glb.error());
    }
    MeshFile file;
    file.metres = true;
    Eigen::Affine3d upright = Eigen::Affine3d::Identity();
    upright.rotate(Eigen::AngleAxisd(pi / 2, Vec3::UnitX())); // y is up in glTF
    for (const json& root : roots(glb->document)) {
        if (auto ok = add_node(*glb, root, upright, 0, file.mesh); !ok) {
            return tl::make_unexpected(ok.error());
        }
    }
    return file;
}

} // namespace rhombloom
