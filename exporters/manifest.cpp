#include "exporters/manifest.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "exporters/code_points.h"
#include "exporters/sha256.h"
#include "exporters/words.h"

namespace rhombloom {

namespace {

using nlohmann::ordered_json;

double rounded(double value, double unit)
{
    return std::round(value / unit) * unit;
}

//! One paragraph in lines of at most 78 characters; the first begins with \p head, the others stand under its text.
std::string wrapped_paragraph(const std::string& text, const std::string& head)
{
    constexpr std::size_t width = 78;
    std::string result;
    std::string line = head;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (line.size() > head.size() && line.size() + 1 + word.size() > width) {
            result += line + "\n";
            line = std::string(head.size(), ' ');
        }
        line += (line.size() > head.size() ? " " : "") + word;
        begin = end + 1;
    }
    return result + line + "\n";
}

//! Paragraphs, all under the first one's text.
std::string wrapped(const std::string& text, const std::string& head)
{
    std::string result;
    std::string indent = head;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (end > begin) {
            result += wrapped_paragraph(text.substr(begin, end - begin), indent);
            indent = std::string(head.size(), ' ');
        }
        begin = end + 1;
    }
    return result;
}

std::string contents(const FileSet& files)
{
    const std::pair<const char*, const char*> known[] = {
        {"cut/sheet-01.svg", "cut/sheet-*.svg, .dxf   what to cut; the same "
                             "sheets in both formats, in millimetres"},
        {"cut/coupon.svg", "cut/coupon.svg, .dxf    a small test piece: cut it FIRST"},
        {"cut/template-1to1.pdf", "cut/template-1to1.pdf   the same by hand: print at 100 %, trace, cut"},
        {"booklet.pdf", "booklet.pdf             how to put the elements "
                        "together, step by step"},
        {"booklet-imposed.pdf", "booklet-imposed.pdf     the same for "
                                "double-sided printing and folding"},
        {"preview.html", "preview.html            double-click: turn it, play "
                         "the steps; works offline"},
        {"preview.glb", "preview.glb             the 3D model, small; "
                        "preview-plain.glb opens everywhere"},
        {"thumbnail.png", "thumbnail.png           a picture"},
        {"target.png", "target.png              the mesh that was imported, and the elements beside it"},
        {"hooks/element.scad", "hooks/                  the element and its "
                               "fittings for OpenSCAD and 3D printers"},
        {"plan.json", "plan.json, surface.json, kit.json   the same for other programs"},
    };
    std::string text;
    for (const auto& [name, line] : known) {
        text += files.contains(name) ? std::string("  ") + line + "\n" : "";
    }
    return text;
}

std::string amounts(const Summary& s)
{
    const CutReport& cut = s.cut;
    std::string text = "  " + plural(s.build.elements, "element") + " in the finished piece";
    if (s.scorecard.parts_needed > s.build.elements) {
        text += ", " + std::to_string(s.scorecard.parts_needed) + " while building";
    }
    text += cut.spares > 0 ? ", and " + plural(cut.spares, "spare") + "\n" : "\n";
    text += "  " + plural(cut.sheets, "sheet") + " of " + to_fixed(s.options.cut.sheet_width, 1) + " x " +
            to_fixed(s.options.cut.sheet_height, 1) + " mm, " + s.piece.material.title + ", " +
            to_fixed(100 * cut.utilisation, 0) + " % used\n";
    text += "  " + to_fixed(cut.cut_length_m, 1) + " m to cut, " + duration(cut.minutes, 1) + "; the parts weigh " +
            to_fixed(cut.mass_g, 0) + " g\n";
    text += wrapped("(assumed, not measured: " + cut.speeds_text + ")", "  ");
    if (cut.cost) {
        text += "  cost " + to_fixed(*cut.cost, 2) + " at the prices given\n";
    }
    return text + "  " + duration(s.scorecard.minutes, 5) + " to assemble\n";
}

std::string first_steps(const Summary& s)
{
    const std::string size =
        s.cut.coupon_text.empty() ? "the sheet must have its size" : "the square must measure 50 mm";
    const std::string file = s.cut.coupon_text.empty() ? "cut/sheet-01" : "cut/coupon";
    std::string text = wrapped("Open " + file + " in your cutting program: " + size +
                                   ". Give each layer (or colour) its job: " + s.cut.layers_text + ".",
                               "  1. ");
    text += wrapped(s.cut.coupon_text, "  2. ");
    text += wrapped("Cut the sheets. " + s.piece.material.laser, "  3. ");
    return text + wrapped("Follow booklet.pdf. Start with a good hour and a table.", "  4. ");
}

} // namespace

namespace {

//! How far the imported networks were from their targets, as they were made.
ordered_json imports(const Summary& s)
{
    auto list = ordered_json::array();
    const double la = s.piece.element.la;
    for (const Operation& operation : s.design.operations) {
        const auto* import = std::get_if<Import>(&operation);
        if (import == nullptr || !import->distance) {
            continue;
        }
        const auto both = [la](double rms, double max) -> ordered_json {
            return {{"rms_mm", rms},
                    {"max_mm", max},
                    {"rms_la", rounded(rms / la, 1e-6)},
                    {"max_la", rounded(max / la, 1e-6)}};
        };
        const ImportDistance& d = *import->distance;
        list.push_back({{"id", import->id},
                        {"target_sha256", import->target_sha256},
                        {"elements_to_target", both(d.to_target_rms, d.to_target_max)},
                        {"target_to_elements", both(d.from_target_rms, d.from_target_max)}});
    }
    return list;
}

} // namespace

std::string manifest_json(const Summary& s, const FileSet& files)
{
    ordered_json root = {{"format", "rhombloom-kit"}, {"version", 1}, {"program", s.options.program_version}};
    root["title"] = s.title;
    root["element"] = {{"la_mm", s.piece.element.la},
                       {"lb_mm", s.piece.element.lb},
                       {"alpha_deg", rounded(degrees(s.piece.element.alpha), 1e-9)},
                       {"thickness_mm", s.piece.element.thickness}};
    root["material"] = s.piece.material.name;
    root["elements"] = s.build.elements;
    root["flipped"] = s.build.flipped;
    root["parts_needed"] = s.scorecard.parts_needed;
    root["max_stretch"] = s.build.embedding.max_stretch;
    root["min_defect_deg"] = rounded(degrees(s.build.defects.min), 1e-9);
    root["max_defect_deg"] = rounded(degrees(s.build.defects.max), 1e-9);
    root["assembly_minutes"] = rounded(s.scorecard.minutes, 0.1);
    if (s.options.parts.contains(KitPart::Cut)) {
        root["machine"] = s.options.cut.machine;
        root["sheet_mm"] = {s.options.cut.sheet_width, s.options.cut.sheet_height};
        root["kerf_mm"] = {s.piece.parameters.kerf.x, s.piece.parameters.kerf.y};
        root["sheets"] = s.cut.sheets;
        root["spares"] = s.cut.spares;
        root["utilisation"] = rounded(s.cut.utilisation, 1e-6);
        root["cut_length_m"] = rounded(s.cut.cut_length_m, 1e-6);
        root["engrave_length_m"] = rounded(s.cut.engrave_length_m, 1e-6);
        root["travel_m"] = rounded(s.cut.travel_m, 1e-6);
        root["pierces"] = s.cut.pierces;
        root["cut_minutes"] = rounded(s.cut.minutes, 1e-3);
        root["assumed_cut_speed_mm_s"] = s.cut.speeds.cut;
        root["assumed_speeds"] = s.cut.speeds_text;
        root["layers"] = s.cut.layers_text;
        root["mass_g"] = rounded(s.cut.mass_g, 1e-3);
        root["remnant_mm"] = {rounded(s.cut.remnant.width, 1e-3), rounded(s.cut.remnant.height, 1e-3)};
        if (s.cut.cost) {
            root["cost"] = rounded(*s.cut.cost, 1e-2);
        }
    }
    if (auto list = imports(s); !list.empty()) {
        root["imports"] = std::move(list);
    }
    root["warnings"] = s.warnings;
    for (const BulbFit& fit : s.bulbs) {
        root["bulb_clearance_mm"][fit.bulb.name] = rounded(fit.clearance, 0.01);
    }
    for (const auto& [name, bytes] : files) {
        root["files"][name] = {{"bytes", bytes.size()}, {"sha256", sha256(bytes)}};
    }
    return root.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string readme_text(const Summary& s, const FileSet& files)
{
    const std::string title = s.title.empty() ? "A rhombloom kit" : s.title;
    std::string text = title + "\n" + std::string(std::min<std::size_t>(code_points(title).size(), 78), '=') + "\n\n";
    text += "In this folder\n" + contents(files) + "\n";
    if (s.options.parts.contains(KitPart::Cut)) {
        text += "What it takes\n" + amounts(s) + "\nWhat to do first\n" + first_steps(s) + "\n";
    }
    text += "If it becomes a lamp\n" +
            wrapped("LED bulbs only, 8 W or less, at least 30 mm from the elements. The cord carries the "
                    "lamp, not the shade. " +
                        bulbs_text(s.bulbs) + s.piece.material.heat,
                    "  ");
    for (const std::string& warning : s.warnings) {
        text += "\nMind this\n" + wrapped(warning, "  ");
    }
    return text;
}

std::vector<std::string> listed_files(const std::string& manifest)
{
    const auto root = nlohmann::json::parse(manifest, nullptr, false);
    std::vector<std::string> names;
    if (root.is_object() && root.value("format", "") == "rhombloom-kit" && root.contains("files") &&
        root["files"].is_object()) {
        for (const auto& [name, entry] : root["files"].items()) {
            names.push_back(name);
        }
    }
    return names;
}

} // namespace rhombloom
