#include "exporters/scad.h"

#include <fstream>
#include <sstream>

#include "core/text.h"

namespace rhombloom {

namespace {

//! A parameter of the templates and its literal.
struct Literal
{
    std::string name;
    std::string text;
};

using Literals = std::vector<Literal>;

//! Twelve decimals lose less than 1e-9 mm and turn 7.040000000000001 into 7.04.
std::string literal(double value)
{
    return to_fixed(value, 12);
}

Literals element_literals(const HookParameters& p)
{
    return {{"la", literal(p.la)},
            {"lb", literal(p.lb)},
            {"alpha", literal(degrees(p.alpha))},
            {"thickness", literal(p.thickness)},
            {"slit", literal(p.slit)},
            {"finger_width", literal(p.finger_width)},
            {"finger_length", literal(p.finger_length)},
            {"finger_turn", literal(degrees(p.finger_turn))},
            {"hole_radius", literal(p.hole_radius)},
            {"lip", literal(p.lip)},
            {"lip_rounding", literal(p.lip_rounding)},
            {"barb", literal(p.barb)},
            {"seat_clearance", literal(p.seat_clearance)},
            {"neck_setback", literal(p.neck_setback)},
            {"relief", literal(p.relief)},
            {"scoop_depth", literal(p.scoop_depth)}};
}

Expected<std::string> load_template(const std::string& name)
{
    const std::string path = std::string(RHOMBLOOM_TEMPLATES) + "/" + name;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf())) {
        return machine_failure(path + ": this template cannot be read; the checkout of rhombloom is incomplete");
    }
    return text.str();
}

Expected<std::string> with_literals(std::string scad, const Literals& literals)
{
    for (const Literal& l : literals) {
        auto replaced = with_literal(scad, l.name, l.text);
        if (!replaced) {
            return replaced;
        }
        scad = std::move(*replaced);
    }
    return scad;
}

std::string joined(const Literals& literals, std::string Literal::*part)
{
    std::string list;
    for (const Literal& l : literals) {
        list += (list.empty() ? "" : ", ") + l.*part;
    }
    return "[" + list + "]";
}

//! Twice the area of the polygon of the outline's vertices, arcs left out: depends on every vertex, not on how fine
//! the arcs are drawn.
double vertex_polygon_area(const Path& outline)
{
    Path straight = outline;
    for (PathVertex& v : straight.vertices) {
        v.bulge = 0;
    }
    return area(straight);
}

std::string fingerprint(const Literals& literals, const Path& outline)
{
    return "\n/* [Hidden] */\n"
           "// The project's values: the part tells whether it still is the project's and proves its outline.\n"
           "project_values = " +
           joined(literals, &Literal::text) +
           ";\n"
           "project_vertices = " +
           std::to_string(outline.vertices.size()) +
           ";\n"
           "project_area = " +
           literal(vertex_polygon_area(outline)) +
           ";\n"
           "is_project = " +
           joined(literals, &Literal::name) +
           " == project_values;\n"
           "if (is_project) {\n"
           "    assert(len(element_path()) == project_vertices && abs(area(element_path()) - project_area) < 1e-6,\n"
           "           \"this template and rhombloom draw different outlines: please report it\");\n"
           "}\n"
           "echo(is_project ? \"matches the project\" : \"CUSTOMISED: differs from the project's files\");\n";
}

std::string readme(const std::string& title, const HookParameters& p)
{
    return "OpenSCAD templates of " + (title.empty() ? "this project" : title) +
           "\n\n"
           "element.scad   the element, " +
           to_fixed(p.la, 2) + " x " + to_fixed(p.lb, 2) + " mm, sheet of " + to_fixed(p.thickness, 2) +
           " mm: a flat outline to cut or a solid to print\n\n"
           "Open a file in OpenSCAD (openscad.org, version 2021.01 or later) and show Window > Customizer.\n"
           "F6 computes the part; File > Export saves SVG or DXF (cut) or STL (print).\n"
           "The console tells whether the part still matches the project or is customised.\n"
           "No library is needed. On the command line:\n\n"
           "  openscad -o element.svg element.scad\n"
           "  openscad -o element.stl -D 'part=\"print\"' element.scad\n";
}

} // namespace

std::string clean_title(const std::string& title)
{
    constexpr std::size_t longest = 60;
    std::string clean;
    for (const char c : title) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (clean.size() < longest &&
            (letter || (c >= '0' && c <= '9') || c == ' ' || c == '.' || c == '_' || c == '-')) {
            clean += c;
        }
    }
    return clean;
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

Expected<FileSet> hook_files(const HookParameters& parameters, const std::string& title)
{
    const auto outline = element_outline(parameters);
    if (!outline) {
        return tl::make_unexpected(outline.error());
    }
    const Literals literals = element_literals(parameters);
    const auto blank = load_template("element.scad");
    if (!blank) {
        return tl::make_unexpected(blank.error());
    }
    auto scad = with_literals(*blank, literals);
    if (!scad) {
        return tl::make_unexpected(scad.error());
    }
    const std::string clean = clean_title(title);
    const std::string heading = clean.empty() ? "" : "// Project: " + clean + "\n";
    return FileSet{{"hooks/element.scad", heading + *scad + fingerprint(literals, *outline)},
                   {"hooks/README.txt", readme(clean, parameters)}};
}

} // namespace rhombloom
