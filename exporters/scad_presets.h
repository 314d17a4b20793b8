#pragma once

#include "exporters/materials.h"
#include "exporters/scad.h"

namespace rhombloom {

//! \brief A set of values that OpenSCAD's Customizer lists under a name; all values as OpenSCAD writes them.
struct ScadPreset
{
    std::string name;
    std::vector<std::pair<std::string, std::string>> values;
};

//! \brief The presets of a template: materials, ways of cutting and sizes for the sheet, sizes and parts for the
//! connectors. Only combinations that pass the hook checks with the material's strain limit.
std::vector<ScadPreset> scad_presets(const ScadTemplate& scad, const std::vector<Material>& materials);

//! \brief The values of one piece, for a preset.
ScadPreset scad_preset(const std::string& name, ScadPart part, const PieceParameters& parameters);

//! \brief The file that belongs beside NAME.scad as NAME.json.
std::string preset_file(const std::vector<ScadPreset>& presets);

//! \brief \p file, a preset file, with \p preset as its first entry.
//! \return a machine failure when \p file is none.
Expected<std::string> with_preset(const std::string& file, const ScadPreset& preset);

} // namespace rhombloom
