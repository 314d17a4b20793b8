#include "exporters/surface_file.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "exporters/save.h"

namespace rhombloom {

namespace {

using nlohmann::ordered_json;

std::string coordinates(const Vec3& p)
{
    return to_text(p.x()) + " " + to_text(p.y()) + " " + to_text(p.z());
}

std::string indices(const Quad& q, int first)
{
    std::string text;
    for (const int v : q) {
        text += " " + std::to_string(v + first);
    }
    return text;
}

ordered_json embedding_json(const EmbedReport& report)
{
    return {{"converged", report.converged},
            {"iterations", report.iterations},
            {"energy_mm", report.energy},
            {"spring_energy_mm", report.spring_energy},
            {"concavity_energy_mm", report.concavity_energy},
            {"concavity_weight", report.concavity_weight},
            {"convex_weight", report.convex_weight},
            {"gradient_norm", report.gradient_norm},
            {"max_stretch", report.max_stretch}};
}

//! A list with one entry per line: readable, and small differences stay small.
std::string lines(const std::string& key, const std::vector<std::string>& entries)
{
    std::string text = "\"" + key + "\": [";
    for (std::size_t i = 0; i < entries.size(); ++i) {
        text += (i == 0 ? "\n" : ",\n") + entries[i];
    }
    return text + "\n]";
}

std::string quoted(const std::string& text)
{
    return ordered_json(text).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

} // namespace

std::string surface_json(const Surface& surface, const Element& element, const EmbedReport& embedding)
{
    const SurfaceLists parts = lists(surface);
    const ordered_json element_json = {{"la_mm", element.la},
                                       {"lb_mm", element.lb},
                                       {"alpha_deg", std::round(degrees(element.alpha) * 1e10) / 1e10},
                                       {"thickness_mm", element.thickness}};
    std::vector<std::string> vertices;
    std::vector<std::string> sides;
    std::vector<std::string> faces;
    std::vector<std::string> facing;
    std::vector<std::string> component;
    for (std::size_t v = 0; v < parts.positions.size(); ++v) {
        const Vec3& p = parts.positions[v];
        vertices.push_back("[" + to_text(p.x()) + ", " + to_text(p.y()) + ", " + to_text(p.z()) + "]");
        sides.emplace_back(parts.sides[v] == Side::Long ? "\"long\"" : "\"short\"");
    }
    for (std::size_t f = 0; f < parts.quads.size(); ++f) {
        const Quad& q = parts.quads[f];
        faces.push_back("[" + std::to_string(q[0]) + ", " + std::to_string(q[1]) + ", " + std::to_string(q[2]) + ", " +
                        std::to_string(q[3]) + "]");
        facing.emplace_back(parts.facing[f] == Facing::Front ? "\"front\"" : "\"back\"");
        component.push_back(quoted(parts.components.at(parts.component[f])));
    }
    return "{\"format\": \"rhombloom-surface\", \"version\": 1,\n\"element\": " + element_json.dump() + ",\n" +
           lines("vertices_mm", vertices) + ",\n" + lines("vertex_side", sides) + ",\n" + lines("faces", faces) +
           ",\n" + lines("facing", facing) + ",\n" + lines("component", component) +
           ",\n\"embedding\": " + embedding_json(embedding).dump() + "}\n";
}

std::string surface_obj(const Surface& surface)
{
    const SurfaceLists parts = lists(surface);
    std::string text = "# rhombloom surface, millimetres; one quad per element\n";
    for (const Vec3& p : parts.positions) {
        text += "v " + coordinates(p) + "\n";
    }
    int group = -1;
    for (std::size_t f = 0; f < parts.quads.size(); ++f) {
        if (parts.component[f] != group) {
            group = parts.component[f];
            text += "g component_" + std::to_string(group) + "\n";
        }
        text += "f" + indices(parts.quads[f], 1) + "\n";
    }
    return text;
}

std::string surface_off(const Surface& surface)
{
    const SurfaceLists parts = lists(surface);
    std::string text = "OFF\n" + std::to_string(parts.positions.size()) + " " + std::to_string(parts.quads.size()) +
                       " " + std::to_string(surface.n_edges()) + "\n";
    for (const Vec3& p : parts.positions) {
        text += coordinates(p) + "\n";
    }
    for (const Quad& q : parts.quads) {
        text += "4" + indices(q, 0) + "\n";
    }
    return text;
}

std::string surface_ply(const Surface& surface)
{
    const SurfaceLists parts = lists(surface);
    std::string text = "ply\nformat ascii 1.0\ncomment rhombloom surface, millimetres\nelement vertex " +
                       std::to_string(parts.positions.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                       std::to_string(parts.quads.size()) +
                       "\nproperty list uchar int vertex_indices\nproperty uchar back\nend_header\n";
    for (const Vec3& p : parts.positions) {
        text += coordinates(p) + "\n";
    }
    for (std::size_t f = 0; f < parts.quads.size(); ++f) {
        text += "4" + indices(parts.quads[f], 0) + (parts.facing[f] == Facing::Back ? " 1\n" : " 0\n");
    }
    return text;
}

Expected<std::string> surface_file(const std::string& path, const Surface& surface, const Element& element,
                                   const EmbedReport& embedding)
{
    const std::string ending = file_ending(path);
    if (ending == "json") {
        return surface_json(surface, element, embedding);
    }
    if (ending == "obj") {
        return surface_obj(surface);
    }
    if (ending == "off") {
        return surface_off(surface);
    }
    if (ending == "ply") {
        return surface_ply(surface);
    }
    return refuse("\"" + path + "\" has no known ending: expected .json, .obj, .off or .ply");
}

} // namespace rhombloom
