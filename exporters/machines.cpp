#include "exporters/machines.h"

#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "core/text.h"

namespace rhombloom {

namespace {

// Film of half a millimetre. CO2 lasers of 40-60 W; diodes are slower; knives lift and turn at every corner.
constexpr Speeds laser = {20, 80, 250, 2000, 0.2};
constexpr Speeds small_laser = {15, 60, 200, 1500, 0.2};
constexpr Speeds diode = {6, 40, 150, 1500, 0.3};
constexpr Speeds knife = {40, 40, 100, 800, 0.4};
constexpr Speeds hand = {5, 10, 100, 1000, 4};

using enum ColourPreset;
constexpr auto r2000 = DxfVersion::R2000;
constexpr auto r12 = DxfVersion::R12;

constexpr Machine presets[] = {
    {"k40", "K40 laser", 300, 200, 3, K40, false, r2000, small_laser},
    {"glowforge", "Glowforge", 495, 279, 3, Glowforge, false, r2000, laser},
    {"xtool-m1", "xTool M1", 385, 300, 3, LightBurn, true, r2000, diode},
    {"xtool-d1-pro", "xTool D1 Pro", 430, 390, 3, LightBurn, true, r2000, diode},
    {"xtool-s1", "xTool S1", 498, 319, 3, LightBurn, true, r2000, diode},
    {"xtool-p2", "xTool P2", 600, 308, 3, LightBurn, true, r2000, laser},
    {"ortur-lm", "Ortur Laser Master", 400, 430, 3, LightBurn, true, r2000, diode},
    {"epilog-zing-16", "Epilog Zing 16", 406, 305, 3, Trotec, true, r2000, laser},
    {"epilog-24x12", "Epilog 24 x 12 in", 600, 300, 3, Trotec, true, r2000, laser},
    {"trotec-speedy-100", "Trotec Speedy 100", 610, 305, 3, Trotec, true, r2000, laser},
    {"thunder-nova-24", "Thunder Nova 24", 610, 406, 3, LightBurn, true, r2000, laser},
    {"thunder-nova-35", "Thunder Nova 35", 900, 600, 3, LightBurn, true, r2000, laser},
    {"cricut-12x12", "Cricut, 12 x 12 in mat", 292.1, 292.1, 3, Glowforge, false, r12, knife},
    {"cricut-12x24", "Cricut, 12 x 24 in mat", 292.1, 596.9, 3, Glowforge, false, r12, knife},
    {"silhouette-portrait", "Silhouette Portrait, 8 x 12 in mat", 203, 304.8, 3, Glowforge, false, r12, knife},
    {"silhouette-cameo-12x12", "Silhouette Cameo, 12 x 12 in mat", 304.8, 304.8, 3, Glowforge, false, r12, knife},
    {"silhouette-cameo-12x24", "Silhouette Cameo, 12 x 24 in mat", 304.8, 609.6, 3, Glowforge, false, r12, knife},
    {"a4", "A4 by hand", 210, 297, 6.35, LightBurn, true, r2000, hand},
    {"a3", "A3 by hand", 297, 420, 6.35, LightBurn, true, r2000, hand},
    {"letter", "Letter by hand", 215.9, 279.4, 6.35, LightBurn, true, r2000, hand},
};

//! What people say of machines that come with one mat.
constexpr std::pair<std::string_view, std::string_view> short_names[] = {
    {"cricut", "cricut-12x12"},          {"portrait", "silhouette-portrait"},
    {"cameo", "silhouette-cameo-12x12"}, {"silhouette-cameo", "silhouette-cameo-12x12"},
    {"speedy-100", "trotec-speedy-100"},
};

//! Lower case, with words joined by one '-'.
std::string normal_name(std::string_view name)
{
    std::string result;
    for (const char c : name) {
        if (c == ' ' || c == '_' || c == '-') {
            result += result.empty() || result.back() == '-' ? "" : "-";
        } else {
            result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        }
    }
    return result;
}

std::optional<double> parse_length(std::string_view text)
{
    double value = 0;
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, value, std::chars_format::fixed);
    return result.ec == std::errc{} && result.ptr == end ? std::optional(value) : std::nullopt;
}

bool is_sheet_length(double value)
{
    return value >= 50 && value <= 5000; // false for NaN
}

struct NamedColours
{
    std::string_view name;
    ColourPreset preset;
};

constexpr std::array<NamedColours, 9> colour_names = {{{"lightburn", LightBurn},
                                                       {"trotec", Trotec},
                                                       {"uls", Trotec},
                                                       {"epilog", Trotec},
                                                       {"k40", K40},
                                                       {"ponoko", Ponoko},
                                                       {"glowforge", Glowforge},
                                                       {"boxes", Boxes},
                                                       {"xtool", LightBurn}}};

} // namespace

std::span<const Machine> machines()
{
    return presets;
}

Expected<Machine> find_machine(std::string_view name)
{
    std::string wanted = normal_name(name);
    for (const auto& [short_name, full] : short_names) {
        wanted = wanted == short_name ? std::string(full) : wanted;
    }
    std::string names;
    for (const Machine& machine : presets) {
        if (machine.name == wanted) {
            return machine;
        }
        names += (names.empty() ? "" : ", ") + std::string(machine.name);
    }
    return refuse("the machine \"" + std::string(name) + "\" is unknown: expected one of " + names +
                  ", or give the sheet, e.g. 600x400");
}

Expected<SheetSize> parse_sheet(std::string_view text)
{
    const bool inches = text.ends_with("in");
    std::string_view sizes = text;
    if (inches || text.ends_with("mm")) {
        sizes.remove_suffix(2);
    }
    const std::size_t cross = sizes.find_first_of("xX");
    if (cross != std::string_view::npos) {
        const double unit = inches ? 25.4 : 1;
        const auto width = parse_length(sizes.substr(0, cross));
        const auto height = parse_length(sizes.substr(cross + 1));
        if (width && height && is_sheet_length(*width * unit) && is_sheet_length(*height * unit)) {
            return SheetSize{*width * unit, *height * unit};
        }
    }
    return refuse("\"" + std::string(text.substr(0, 40)) +
                  "\" is no size of a sheet: expected WIDTHxHEIGHT in mm from 50 to 5000 each, e.g. 600x400");
}

Expected<ColourPreset> parse_colours(std::string_view name)
{
    const std::string wanted = normal_name(name);
    std::string names;
    for (const NamedColours& c : colour_names) {
        if (c.name == wanted) {
            return c.preset;
        }
        names += (names.empty() ? "" : ", ") + std::string(c.name);
    }
    return refuse("the colour preset \"" + std::string(name) + "\" is unknown: expected one of " + names);
}

double cut_stroke(ColourPreset preset)
{
    return preset == Trotec || preset == Ponoko ? 0.01 : 0.1;
}

unsigned cut_colour(ColourPreset preset, LayerUse use)
{
    // Engrave, inner cut, outer cut, sheet border, reference square.
    struct Row
    {
        ColourPreset preset;
        std::array<unsigned, 5> rgb;
    };
    constexpr std::array<Row, 6> table = {{
        // Layers 00, 01, 02 run in this order; T1 and T2 are tool layers, which the laser never sees.
        {LightBurn, {0x000000, 0x0000FF, 0xFF0000, 0xF36926, 0x0C96D9}},
        // Drivers of Trotec, ULS and Epilog know pure colours only; give yellow and cyan no job.
        {Trotec, {0x0000FF, 0x00FF00, 0xFF0000, 0xFFFF00, 0x00FFFF}},
        // K40 Whisperer: red cuts, blue engraves lines; it would scan any other colour as a picture.
        {K40, {0x0000FF, 0xFF0000, 0xFF0000, 0x0000FF, 0x0000FF}},
        // Blue cuts, red engraves lines, the orange of the template's frame is ignored.
        {Ponoko, {0xFF0000, 0x0000FF, 0x0000FF, 0xF6921E, 0xF6921E}},
        // One job per colour, sorted by its value.
        {Glowforge, {0x000000, 0x0000FF, 0xFF0000, 0x00FF00, 0x00FFFF}},
        // The convention of the generator boxes.py: red is never cut.
        {Boxes, {0x00FF00, 0x0000FF, 0x000000, 0xFF0000, 0xFF0000}},
    }};
    for (const Row& row : table) {
        if (row.preset == preset) {
            return row.rgb[static_cast<std::size_t>(use)];
        }
    }
    expects(false, "cut_colour: every preset has its row");
    return 0;
}

} // namespace rhombloom
