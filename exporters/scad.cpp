#include "exporters/scad.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "exporters/scad_presets.h"

namespace rhombloom {

namespace {

constexpr std::size_t longest_template = 1 << 20;
constexpr std::size_t longest_title = 60;

Expected<std::string> load_template(const std::string& name)
{
    return load_file(std::string(RHOMBLOOM_TEMPLATES) + "/" + name, longest_template);
}

//! \p text with its one \p old replaced; a machine failure when there is none or another one.
Expected<std::string> replaced_once(const std::string& text, const std::string& old, const std::string& fresh)
{
    const std::size_t found = text.find(old);
    if (found == std::string::npos || text.find(old, found + 1) != std::string::npos) {
        return machine_failure("the OpenSCAD template does not have \"" + old + "\" exactly once");
    }
    return text.substr(0, found) + fresh + text.substr(found + old.size());
}

std::string slider(double min, double step, double max)
{
    return "[" + to_fixed(min, 12) + ":" + to_fixed(step, 12) + ":" + to_fixed(max, 12) + "]";
}

std::string limits(const Parameter& row, double min, double max)
{
    return "need_number(\"" + row.name + "\", " + row.name + ", " + to_fixed(min, 12) + ", " + to_fixed(max, 12) + ",";
}

//! The slider and the assert of a row widened to the value.
Expected<std::string> with_range(const std::string& scad, const Parameter& row, const std::string& literal,
                                 double value)
{
    if (value >= row.min && value <= row.max) {
        return scad;
    }
    const double min = std::min(row.min, value);
    const double max = std::max(row.max, value);
    const std::string line = "\n" + row.name + " = " + literal + "; // ";
    return replaced_once(scad, line + slider(row.min, row.step, row.max), line + slider(min, row.step, max))
        .and_then([&](const std::string& s) {
            return replaced_once(s, limits(row, row.min, row.max), limits(row, min, max));
        });
}

Expected<std::string> with_parameters(Expected<std::string> scad, ScadPart part, const PieceParameters& parameters)
{
    for (const Parameter& row : scad_parameters(part)) {
        const std::string literal = scad_literal(row, parameters);
        const double value = row.get(parameters);
        scad = scad.and_then([&](const std::string& s) { return with_literal(s, row.name, literal); })
                   .and_then([&](const std::string& s) { return with_range(s, row, literal, value); });
    }
    return scad.and_then(
        [&](const std::string& s) { return with_literal(s, "hook_sizes", "\"" + hook_sizes(parameters) + "\""); });
}

//! The variable that holds a row's value in the templates once `hook_sizes` is applied: its symbol.
std::string resolved_name(const Parameter& row)
{
    return row.section == "Element" || row.name == "slit_clearance" ? row.name : row.symbol;
}

//! The area of the polygon of the outline's vertices: depends on every vertex, not on how fine the arcs are drawn.
double vertex_polygon_area(Path outline)
{
    for (PathVertex& v : outline.vertices) {
        v.bulge = 0;
    }
    return area(outline);
}

std::string outline_proof(const Path& outline)
{
    return "project_vertices = " + std::to_string(outline.vertices.size()) +
           ";\n"
           "project_area = " +
           to_fixed(vertex_polygon_area(outline), 9) +
           ";\n"
           "project_proof = assert(!is_project || (len(element_path()) == project_vertices\n"
           "    && abs(area(element_path()) - project_area) < 1e-6),\n"
           "    \"this template and rhombloom draw different outlines: please report it\") true;\n";
}

std::string fingerprint(ScadPart part, const PieceParameters& parameters, const Path& outline)
{
    std::string names;
    std::string values;
    for (const Parameter& row : scad_parameters(ScadPart::Connector)) {
        names += (names.empty() ? "" : ", ") + resolved_name(row);
        values += (values.empty() ? "" : ", ") + scad_literal(row, parameters);
    }
    return "\n/* [Hidden] */\n\n"
           "// The project's values: the file tells whether it still is the project's part and proves its outline.\n"
           "project_values = [" +
           values + "];\nis_project = norm([" + names + "] - project_values) < 1e-6;\n" +
           (part == ScadPart::Sheet ? outline_proof(outline) : "") +
           "echo(is_project ? \"matches the project\" : \"CUSTOMISED: differs from the project's files\");\n";
}

std::string readme(const std::string& title, const HookParameters& p)
{
    return "OpenSCAD templates of " + (title.empty() ? "this project" : title) + "\n\nElement " + to_fixed(p.la, 2) +
           " x " + to_fixed(p.lb, 2) + " mm, acute angle " + to_fixed(degrees(p.alpha), 3) + " degrees, sheet " +
           to_fixed(p.thickness, 2) + " mm, slit " + to_fixed(p.slit, 2) +
           " mm\n\n"
           "fit_coupon.scad   cut this first: a real joint and a ladder of slits that tell the right slit_clearance\n"
           "element.scad      the element: an outline to cut or a flat solid to print\n"
           "connectors.scad   a clip that holds a joint whose hook broke, a snap rivet, a row of test holes\n"
           "lamp_parts.scad   ring and cap for the socket, edge clips, strain relief, hanging ring, stand\n\n"
           "Open a file in OpenSCAD (openscad.org, version 2021.01 or later) and show Window > Customizer. Presets "
           "for\n"
           "materials and sizes are in the list on top of it (NAME.json beside NAME.scad); the first is this project.\n"
           "F6 computes the part; File > Export saves SVG or DXF (to cut) or STL (to print). The console tells sizes\n"
           "and whether the part still matches the project. No library is needed. On the command line:\n\n"
           "  openscad -o element.svg element.scad\n"
           "  openscad -o element.stl -D 'output=\"print\"' element.scad\n";
}

//! OpenSCAD draws outlines only: where one pass of the tool is wider than the slit, the finished edge is drawn.
PieceParameters with_template_kerf(PieceParameters parameters)
{
    if (std::max(parameters.kerf.x, parameters.kerf.y) >= parameters.hook.slit - narrowest_slit) {
        parameters.kerf = {};
    }
    return parameters;
}

struct Sources
{
    PieceParameters parameters;
    Path outline;
    std::string title; //!< cleaned
};

Expected<void> append_template(FileSet& files, const ScadTemplate& scad, const Sources& from)
{
    auto text = with_parameters(load_template(scad.name + ".scad"), scad.part, from.parameters);
    if (!text) {
        return tl::make_unexpected(text.error());
    }
    auto presets = load_template(scad.name + ".json").and_then([&](const std::string& file) {
        return with_preset(file, scad_preset("This project", scad.part, from.parameters));
    });
    if (!presets) {
        return tl::make_unexpected(presets.error());
    }
    const std::string heading = from.title.empty() ? "" : "// Project: " + from.title + "\n";
    files["hooks/" + scad.name + ".scad"] = heading + *text + fingerprint(scad.part, from.parameters, from.outline);
    files["hooks/" + scad.name + ".json"] = *presets;
    return {};
}

} // namespace

const std::vector<ScadTemplate>& scad_templates()
{
    static const std::vector<ScadTemplate> list = {{"element", ScadPart::Sheet},
                                                   {"fit_coupon", ScadPart::Sheet},
                                                   {"connectors", ScadPart::Connector},
                                                   {"lamp_parts", ScadPart::Connector}};
    return list;
}

std::vector<Parameter> scad_parameters(ScadPart part)
{
    std::vector<Parameter> rows = parameter_table();
    if (part == ScadPart::Connector) {
        std::erase_if(rows, [](const Parameter& row) { return row.section == "Cut"; });
    }
    return rows;
}

std::string scad_literal(const Parameter& row, const PieceParameters& parameters)
{
    // Twelve decimals lose less than 1e-9 mm and turn 7.040000000000001 into 7.04.
    return to_fixed(row.get(parameters), 12);
}

std::string hook_sizes(const PieceParameters& parameters)
{
    Element element;
    element.la = parameters.hook.la;
    element.lb = parameters.hook.lb;
    element.alpha = parameters.hook.alpha;
    element.thickness = parameters.hook.thickness;
    const double clearance = parameters.hook.slit - parameters.hook.thickness;
    const auto automatic = piece_parameters(element, {{"slit_clearance", clearance}});
    const auto rows = scad_parameters(ScadPart::Connector);
    const bool same = automatic && std::all_of(rows.begin(), rows.end(), [&](const Parameter& row) {
                          return std::abs(row.get(*automatic) - row.get(parameters)) < 1e-9;
                      });
    return same ? "automatic" : "given";
}

std::string clean_title(const std::string& title)
{
    std::string clean;
    for (const char c : title) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (letter || (c >= '0' && c <= '9') || c == ' ' || c == '.' || c == '_' || c == '-') {
            clean += c;
        }
    }
    return clean.substr(0, longest_title);
}

Expected<std::string> with_literal(const std::string& scad, const std::string& name, const std::string& value)
{
    const std::string start = "\n" + name + " = ";
    const std::size_t found = scad.find(start);
    const std::size_t begin = found + start.size();
    const std::size_t end = found == std::string::npos ? found : scad.find(';', begin);
    if (end == std::string::npos || scad.find(start, begin) != std::string::npos) {
        return machine_failure("the OpenSCAD template does not set " + name + " exactly once");
    }
    return scad.substr(0, begin) + value + scad.substr(end);
}

Expected<FileSet> hook_files(const PieceParameters& piece, const std::string& title)
{
    const PieceParameters parameters = with_template_kerf(piece);
    const auto outline = element_outline(parameters.hook);
    if (!outline) {
        return tl::make_unexpected(outline.error());
    }
    const Sources from{parameters, *outline, clean_title(title)};
    FileSet files{{"hooks/README.txt", readme(from.title, parameters.hook)}};
    for (const ScadTemplate& scad : scad_templates()) {
        if (auto ok = append_template(files, scad, from); !ok) {
            return tl::make_unexpected(ok.error());
        }
    }
    return files;
}

Expected<FileSet> hook_files(const HookParameters& parameters, const std::string& title)
{
    return hook_files(PieceParameters{parameters, {}}, title);
}

} // namespace rhombloom
