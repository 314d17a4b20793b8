#pragma once

#include <string>
#include <vector>

#include "core/expected.h"

namespace rhombloom {

//! \brief What rhombloom knows about a sheet: one entry of templates/materials.json.
struct Material
{
    std::string name;               //!< e.g. "pp-0.5", for --material
    std::string title;              //!< e.g. "Polypropylene 0.5 mm"
    double thickness = 0;           //!< mm
    double density = 0;             //!< g/cm3
    double strain_limit = 0;        //!< largest strain of a bowed sheet that leaves no mark, 0.03 = 3 %
    double finger_strain_limit = 0; //!< of a finger, which bends once and may keep a little of it
    double max_temperature = 0;     //!< degrees Celsius that a lamp may heat it to for years
    std::string heat;               //!< what to mind near a bulb, one sentence
    std::string laser;              //!< how it cuts, one sentence; empty: do not laser
    std::string knife;              //!< one sentence; empty: no knife cuts it
    bool sides_alike = true;        //!< so that mirrored parts may be laid on the sheet
};

//! \brief All presets, in the file's order. Refuses a missing or malformed file with its path.
Expected<std::vector<Material>> materials();

//! \brief The presets of another file of the same form.
Expected<std::vector<Material>> materials(const std::string& path);

//! \brief The preset called \p name; the refusal lists the names there are.
Expected<Material> material(const std::string& name);

//! \brief Mass of a piece of \p area mm2, grams.
double mass(const Material& material, double area);

} // namespace rhombloom
