#include "exporters/materials.h"

#include <fstream>

#include <nlohmann/json.hpp>

namespace rhombloom {

namespace {

Material read_material(const nlohmann::json& json)
{
    Material m;
    m.name = json.at("name");
    m.title = json.at("title");
    m.thickness = json.at("thickness_mm");
    m.density = json.at("density_g_cm3");
    m.strain_limit = json.at("strain_limit");
    m.finger_strain_limit = json.at("finger_strain_limit");
    m.max_temperature = json.at("max_temperature_C");
    m.sides_alike = json.at("sides_alike");
    m.heat = json.at("heat");
    m.laser = json.at("laser");
    m.knife = json.at("knife");
    return m;
}

} // namespace

Expected<std::vector<Material>> materials(const std::string& path)
{
    std::ifstream file(path);
    if (!file) {
        return machine_failure("cannot read the material presets " + path);
    }
    try {
        std::vector<Material> list;
        const nlohmann::json json = nlohmann::json::parse(file);
        for (const nlohmann::json& entry : json.at("materials")) {
            list.push_back(read_material(entry));
        }
        return list;
    } catch (const nlohmann::json::exception& error) {
        return refuse("material presets " + path + ": " + error.what());
    }
}

Expected<std::vector<Material>> materials()
{
    return materials(RHOMBLOOM_TEMPLATES "/materials.json");
}

Expected<Material> material(const std::string& name)
{
    const auto list = materials();
    if (!list) {
        return tl::make_unexpected(list.error());
    }
    std::string known;
    for (const Material& m : *list) {
        if (m.name == name) {
            return m;
        }
        known += (known.empty() ? "" : ", ") + m.name;
    }
    return refuse("material \"" + name + "\" is unknown: expected one of " + known);
}

double mass(const Material& material, double area)
{
    return area * material.thickness * material.density / 1000;
}

} // namespace rhombloom
