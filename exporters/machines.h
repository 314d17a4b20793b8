#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/expected.h"
#include "exporters/dxf.h"

namespace rhombloom {

//! Layer colours that a program or a service understands; see cut_colours().
enum class ColourPreset
{
    LightBurn,
    Trotec,
    K40,
    Ponoko,
    Glowforge,
    Boxes
};

//! \brief What times are computed with. Assumed, not measured: every material wants its own.
struct Speeds
{
    double cut = 20;            //!< mm/s
    double engrave = 80;        //!< mm/s
    double travel = 250;        //!< mm/s, beam off or knife up
    double acceleration = 2000; //!< mm/s2
    double pierce = 0.2;        //!< s, start of each path
};

//! \brief A machine, or a sheet of paper and a hand: what fits in and what its program wants.
struct Machine
{
    std::string_view name;  //!< as given on the command line
    std::string_view title; //!< as people say
    double width = 600;     //!< usable, mm
    double height = 400;
    double margin = 3; //!< left free along the edges, mm
    ColourPreset colours = ColourPreset::LightBurn;
    bool annotations = true; //!< sheet border and reference square: off where every line becomes a job
    DxfVersion dxf = DxfVersion::R2000;
    Speeds speeds = {};
};

//! \brief All presets. Sizes are the usable ones of the makers' data sheets and of open drivers for them.
std::span<const Machine> machines();

//! \brief The machine of that name, case and spaces aside; the refusal lists the names.
Expected<Machine> find_machine(std::string_view name);

struct SheetSize
{
    double width = 0;
    double height = 0;
};

//! \brief "600x400" in mm, also "24x12in". Refuses what is no size, and sizes below 50 or above 5000 mm.
Expected<SheetSize> parse_sheet(std::string_view text);

//! \brief The preset of that name: lightburn, trotec (or uls, epilog), k40, ponoko, glowforge, boxes.
Expected<ColourPreset> parse_colours(std::string_view name);

//! \brief Width of lines in SVG, mm: a hairline where thicker lines would be engraved, else what a screen can show.
double cut_stroke(ColourPreset preset);

//! \brief 0xRRGGBB of a layer.
unsigned cut_colour(ColourPreset preset, LayerUse use);

} // namespace rhombloom
