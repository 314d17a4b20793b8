#include "exporters/gltf.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

template <class T>
std::string raw(const std::vector<T>& values)
{
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) {
        std::memcpy(bytes.data(), values.data(), bytes.size());
    }
    return bytes;
}

void append_word(std::string& bytes, std::uint32_t word)
{
    for (int shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<char>(word >> shift & 0xFF));
    }
}

void append_chunk(std::string& bytes, const char* kind, std::string content, char padding)
{
    content.resize((content.size() + 3) / 4 * 4, padding);
    append_word(bytes, static_cast<std::uint32_t>(content.size()));
    bytes.append(kind, 4);
    bytes += content;
}

std::string packed(const std::vector<Eigen::Vector3f>& points)
{
    std::vector<float> values;
    values.reserve(3 * points.size());
    for (const Eigen::Vector3f& p : points) {
        values.insert(values.end(), {p.x(), p.y(), p.z()});
    }
    return raw(values);
}

Json material(const char* name, const std::array<double, 3>& color, const std::array<double, 3>& emission, bool lit)
{
    Json m{{"name", name},
           {"pbrMetallicRoughness",
            {{"baseColorFactor", {color[0], color[1], color[2], 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}}}};
    if (lit) {
        m["emissiveFactor"] = emission;
    }
    return m;
}

} // namespace

Glb make_glb(const std::string& title)
{
    Glb glb;
    glb.json = {{"asset", {{"version", "2.0"}, {"generator", "rhombloom"}}}, {"scene", 0}};
    glb.json["scenes"] = Json::array({Json::object()});
    if (!title.empty()) {
        glb.json["scenes"][0]["name"] = title;
    }
    glb.json["scenes"][0]["nodes"] = Json::array();
    for (const char* list : {"nodes", "meshes", "materials", "accessors", "bufferViews", "buffers"}) {
        glb.json[list] = Json::array();
    }
    return glb;
}

int add_view(Glb& glb, const std::string& bytes, ViewTarget target, int stride)
{
    glb.buffer.resize((glb.buffer.size() + 3) / 4 * 4, '\0');
    Json view{{"buffer", 0}};
    if (!glb.buffer.empty()) {
        view["byteOffset"] = glb.buffer.size();
    }
    view["byteLength"] = bytes.size();
    if (stride > 0) {
        view["byteStride"] = stride;
    }
    if (target != ViewTarget::None) {
        view["target"] = static_cast<int>(target);
    }
    glb.buffer += bytes;
    glb.json["bufferViews"].push_back(std::move(view));
    return static_cast<int>(glb.json["bufferViews"].size()) - 1;
}

int add_accessor(Glb& glb, int view, Component component, const std::string& type, std::size_t count)
{
    Json accessor = Json::object();
    if (view >= 0) {
        accessor["bufferView"] = view;
    }
    accessor["componentType"] = static_cast<int>(component);
    accessor["count"] = count;
    accessor["type"] = type;
    glb.json["accessors"].push_back(std::move(accessor));
    return static_cast<int>(glb.json["accessors"].size()) - 1;
}

void set_bounds(Glb& glb, int accessor, const std::vector<Eigen::Vector3f>& points)
{
    Eigen::Vector3f low = points.front();
    Eigen::Vector3f high = points.front();
    for (const Eigen::Vector3f& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    glb.json["accessors"][accessor]["min"] = {short_float(low.x()), short_float(low.y()), short_float(low.z())};
    glb.json["accessors"][accessor]["max"] = {short_float(high.x()), short_float(high.y()), short_float(high.z())};
}

int add_points(Glb& glb, const std::vector<Eigen::Vector3f>& points)
{
    const int accessor =
        add_accessor(glb, add_view(glb, packed(points), ViewTarget::Vertices), Component::Float, "VEC3", points.size());
    set_bounds(glb, accessor, points);
    return accessor;
}

int add_normals(Glb& glb, const std::vector<Eigen::Vector3f>& normals)
{
    return add_accessor(glb, add_view(glb, packed(normals), ViewTarget::Vertices), Component::Float, "VEC3",
                        normals.size());
}

int add_indices(Glb& glb, const std::vector<std::array<int, 3>>& triangles)
{
    int largest = 0;
    std::vector<std::uint16_t> small;
    std::vector<std::uint32_t> large;
    for (const auto& t : triangles) {
        for (const int v : t) {
            largest = std::max(largest, v);
            small.push_back(static_cast<std::uint16_t>(v));
            large.push_back(static_cast<std::uint32_t>(v));
        }
    }
    const bool fits = largest < 65535;
    const int view = add_view(glb, fits ? raw(small) : raw(large), ViewTarget::Indices);
    return add_accessor(glb, view, fits ? Component::UInt16 : Component::UInt32, "SCALAR", large.size());
}

std::string glb_bytes(const Glb& glb)
{
    Json document = glb.json;
    document["buffers"] = Json::array({{{"byteLength", (glb.buffer.size() + 3) / 4 * 4}}});
    std::string chunks;
    append_chunk(chunks, "JSON", document.dump(-1, ' ', false, Json::error_handler_t::replace), ' ');
    append_chunk(chunks, std::string("BIN\0", 4).data(), glb.buffer, '\0');
    std::string bytes = "glTF";
    append_word(bytes, 2);
    append_word(bytes, static_cast<std::uint32_t>(12 + chunks.size()));
    return bytes + chunks;
}

double short_float(float value)
{
    char digits[32];
    for (int precision = 1; precision <= 9; ++precision) {
        // to_chars and from_chars: the same in every locale.
        const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, precision);
        double parsed = 0;
        std::from_chars(digits, end.ptr, parsed);
        if (static_cast<float>(parsed) == value) {
            return parsed;
        }
    }
    return value;
}

Eigen::Vector3f to_gltf(const Vec3& mm)
{
    return to_gltf_direction(mm * 1e-3);
}

Eigen::Vector3f to_gltf_direction(const Vec3& direction)
{
    return {static_cast<float>(direction.x()), static_cast<float>(direction.z()), static_cast<float>(-direction.y())};
}

void add_materials(Glb& glb, bool lit)
{
    glb.json["materials"] = Json::array({material("front", {0.9, 0.84, 0.72}, {0.8, 0.55, 0.27}, lit),
                                         material("flipped", {0.86, 0.4, 0.17}, {0.75, 0.3, 0.08}, lit)});
}

} // namespace rhombloom
