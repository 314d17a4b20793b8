#include "exporters/scad_presets.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "exporters/hook_checks.h"

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;
using Value = std::pair<std::string, std::string>;

//! How the flat piece is made, with the kerf to begin with; the coupon tells the real one.
struct Way
{
    std::string title;
    std::string output; //!< of the templates
    double kerf;        //!< mm
};

const Way laser{"laser", "cut", 0.15};
const Way knife{"knife", "cut", 0};
const Way printer{"printed", "print", 0};

//! Short sides, mm: the columns of the dimensions table.
constexpr double sizes[] = {40, 60, 80, 100, 120, 200};

//! The sheet that suits an element of this size, mm.
double usual_thickness(double la)
{
    return la < 70 ? 0.3 : la < 110 ? 0.5 : 0.8;
}

std::vector<Way> ways(const Material& material)
{
    std::vector<Way> result;
    if (!material.laser.empty()) {
        result.push_back(laser);
    }
    if (!material.knife.empty()) {
        result.push_back(knife);
    }
    if (material.name.starts_with("pp-") || material.name.starts_with("petg-")) {
        result.push_back(printer);
    }
    return result;
}

PieceParameters piece(const Material& material, double la, double kerf)
{
    Element element;
    element.la = la;
    element.lb = 1.1 * la;
    element.thickness = material.thickness;
    PieceParameters parameters;
    parameters.hook = hook_parameters(element);
    parameters.kerf = {kerf, kerf};
    return parameters;
}

//! With the widest kerf that presets have.
bool buildable(const Material& material, double la)
{
    const PieceParameters parameters = piece(material, la, laser.kerf);
    return check(parameters.hook, {parameters.kerf, material.strain_limit, material.finger_strain_limit}).has_value();
}

void append_sheets(std::vector<ScadPreset>& presets, const Material& material, double la)
{
    if (!buildable(material, la)) {
        return;
    }
    for (const Way& way : ways(material)) {
        const std::string name = material.title + ", la " + to_fixed(la, 2) + ", " + way.title;
        presets.push_back(scad_preset(name, ScadPart::Sheet, piece(material, la, way.kerf)));
        presets.back().values.emplace_back("output", way.output);
    }
}

//! A part of a connector template and what else it is set to.
struct PartChoice
{
    std::string title;
    std::vector<Value> values;
};

std::vector<PartChoice> connector_parts()
{
    return {{"clip", {{"part", "clip"}}},
            {"rivet", {{"part", "rivet"}}},
            {"holes", {{"part", "holes"}, {"rivet_hole", "4"}}}};
}

//! A ring or a cap needs an element larger than the socket.
std::vector<PartChoice> lamp_parts(double la)
{
    std::vector<PartChoice> parts = {{"hanging ring", {{"part", "hanger"}}},
                                     {"edge clip", {{"part", "edge_clip"}}},
                                     {"strain relief", {{"part", "cord_lock"}}}};
    if (la >= 80) {
        parts.push_back({"ring E27", {{"part", "ring"}, {"socket", "e27"}}});
    }
    if (la >= 60) {
        parts.push_back({"ring E14", {{"part", "ring"}, {"socket", "e14"}}});
        parts.push_back({"cap", {{"part", "cap"}}});
        parts.push_back({"stand", {{"part", "stand"}}});
    }
    return parts;
}

void append_connectors(std::vector<ScadPreset>& presets, const ScadTemplate& scad, double la)
{
    Material usual;
    usual.thickness = usual_thickness(la);
    const PieceParameters parameters = piece(usual, la, 0);
    const std::string size = "la " + to_fixed(la, 2) + ", sheet " + to_fixed(usual.thickness, 2) + " mm, ";
    for (const PartChoice& part : scad.name == "lamp_parts" ? lamp_parts(la) : connector_parts()) {
        presets.push_back(scad_preset(size + part.title, scad.part, parameters));
        auto& values = presets.back().values;
        values.insert(values.end(), part.values.begin(), part.values.end());
    }
}

Json values_object(const ScadPreset& preset)
{
    Json object = Json::object();
    for (const auto& [name, value] : preset.values) {
        object[name] = value;
    }
    return object;
}

Json file_object(Json sets)
{
    return {{"parameterSets", std::move(sets)}, {"fileFormatVersion", "1"}};
}

} // namespace

ScadPreset scad_preset(const std::string& name, ScadPart part, const PieceParameters& parameters)
{
    ScadPreset preset{name, {}};
    for (const Parameter& row : scad_parameters(part)) {
        preset.values.emplace_back(row.name, scad_literal(row, parameters));
    }
    preset.values.emplace_back("hook_sizes", hook_sizes(parameters));
    return preset;
}

std::vector<ScadPreset> scad_presets(const ScadTemplate& scad, const std::vector<Material>& materials)
{
    std::vector<ScadPreset> presets;
    for (const Material& material : materials) {
        for (const double la : sizes) {
            if (scad.part == ScadPart::Sheet) {
                append_sheets(presets, material, la);
            }
        }
    }
    for (const double la : sizes) {
        if (scad.part == ScadPart::Connector) {
            append_connectors(presets, scad, la);
        }
    }
    return presets;
}

std::string preset_file(const std::vector<ScadPreset>& presets)
{
    Json sets = Json::object();
    for (const ScadPreset& preset : presets) {
        sets[preset.name] = values_object(preset);
    }
    return file_object(std::move(sets)).dump(1) + "\n";
}

Expected<std::string> with_preset(const std::string& file, const ScadPreset& preset)
{
    const Json read = Json::parse(file, nullptr, false);
    if (!read.is_object() || !read.contains("parameterSets") || !read["parameterSets"].is_object()) {
        return machine_failure("a preset file of the OpenSCAD templates is no preset file");
    }
    Json sets = Json::object();
    sets[preset.name] = values_object(preset);
    sets.update(read["parameterSets"]);
    return file_object(std::move(sets)).dump(1) + "\n";
}

} // namespace rhombloom
