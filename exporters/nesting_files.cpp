#include "exporters/nesting_files.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "core/units.h"
#include "exporters/dxf.h"
#include "exporters/machines.h"
#include "exporters/nesting_polygon.h"
#include "exporters/svg.h"

namespace rhombloom {

namespace {

//! How far the polygon that is nested may lie outside the true arcs, mm.
constexpr double arc_slack = 0.001;

//! A convex arc as a chain of tangents, a concave one as chords: both keep outside of the piece.
void add_arc_outside(std::vector<Vec2>& polygon, const Vec2& a, const Vec2& b, double bulge, double slack)
{
    const Vec2 chord = b - a;
    const Vec2 centre = 0.5 * (a + b) + Vec2(-chord.y(), chord.x()) * ((1 - bulge * bulge) / (4 * bulge));
    const double sweep = 4 * std::atan(bulge), r = (a - centre).norm();
    const double widest = 2 * std::acos(r / (r + slack));
    const int steps = std::clamp(static_cast<int>(std::ceil(std::abs(sweep) / widest)), 1, 4000);
    const double step = sweep / steps;
    for (int i = 0; i < steps; ++i) {
        if (bulge > 0) {
            const Vec2 out = nesting::turn((i + 0.5) * step) * (a - centre);
            polygon.push_back(centre + out / std::cos(step / 2));
        } else if (i > 0) {
            polygon.push_back(centre + nesting::turn(i * step) * (a - centre));
        }
    }
}

std::string sheet_name(std::size_t index)
{
    const std::string number = std::to_string(index + 1);
    return "sheet-" + (number.size() < 2 ? "0" + number : number);
}

Path placed(const Path& path, const Placement& placement)
{
    return placed(placement.mirrored ? mirrored(path) : path, placement.angle, placement.offset);
}

Path border(const Sheet& sheet)
{
    const Vec2 size(sheet.width, sheet.height);
    return {{{Vec2(0, 0), 0}, {Vec2(size.x(), 0), 0}, {size, 0}, {Vec2(0, size.y()), 0}}, true, "sheet"};
}

Drawing drawing_of(const ReadOutline& outline, const NestOptions& options, const Nesting& nesting, std::size_t index,
                   int first)
{
    const Sheet& sheet = nesting.sheets[index];
    Layer cut{"CUT_OUTER", LayerUse::CutOuter, cut_colour(ColourPreset::LightBurn, LayerUse::CutOuter), {}};
    for (const Placement& placement : sheet.placements) {
        cut.paths.push_back(placed(outline.path, placement));
        cut.paths.back().id = "copy-" + std::to_string(first++);
    }
    Layer edge{"SHEET", LayerUse::Sheet, cut_colour(ColourPreset::LightBurn, LayerUse::Sheet), {border(sheet)}};
    return {sheet.width,
            sheet.height,
            {std::move(cut), std::move(edge)},
            {"spacing: " + to_text(options.spacing) + " mm", "margin: " + to_text(options.margin) + " mm",
             "sheet: " + std::to_string(index + 1) + " of " + std::to_string(nesting.sheets.size()) + ", " +
                 std::to_string(sheet.placements.size()) + " copies"}};
}

nlohmann::ordered_json sheet_json(const Sheet& sheet)
{
    const Vec2 offcut = (sheet.offcut.max - sheet.offcut.min).cwiseMax(0.0);
    return {
        {"width_mm", sheet.width},
        {"height_mm", sheet.height},
        {"remnant", sheet.remnant},
        {"copies", sheet.placements.size()},
        {"offcut_mm",
         {{"x", sheet.offcut.min.x()}, {"y", sheet.offcut.min.y()}, {"width", offcut.x()}, {"height", offcut.y()}}}};
}

nlohmann::ordered_json placements_json(const Nesting& nesting)
{
    auto list = nlohmann::ordered_json::array();
    for (std::size_t s = 0; s < nesting.sheets.size(); ++s) {
        for (const Placement& p : nesting.sheets[s].placements) {
            list.push_back({{"index", list.size()},
                            {"sheet", s},
                            {"angle_deg", degrees(p.angle)},
                            {"mirrored", p.mirrored},
                            {"x", p.offset.x()},
                            {"y", p.offset.y()}});
        }
    }
    return list;
}

std::string nesting_json(const ReadOutline& outline, const NestOptions& options, const Nesting& nesting)
{
    nlohmann::ordered_json json = {
        {"format", "rhombloom-nesting"},
        {"version", 1},
        {"convention", "a copy is the outline, x negated if mirrored, turned by angle_deg counter-clockwise about its "
                       "origin, then moved by (x, y); mm, y up, origin in the sheet's lower left corner"},
        {"spacing_mm", options.spacing},
        {"margin_mm", options.margin},
        {"count", options.count},
        {"per_sheet", nesting.per_sheet},
        {"utilisation", nesting.utilisation}};
    auto& points = json["outline"] = nlohmann::ordered_json::array();
    for (const PathVertex& v : outline.path.vertices) {
        auto point = nlohmann::ordered_json::array({v.point.x(), v.point.y()});
        if (v.bulge != 0) {
            point.push_back(v.bulge);
        }
        points.push_back(std::move(point));
    }
    auto& sheets = json["sheets"] = nlohmann::ordered_json::array();
    for (const Sheet& sheet : nesting.sheets) {
        sheets.push_back(sheet_json(sheet));
    }
    json["placements"] = placements_json(nesting);
    return json.dump(1) + "\n";
}

} // namespace

std::vector<Vec2> enclosing_polygon(const Path& path, double slack)
{
    expects(path.closed, "enclosing_polygon: the path is closed");
    const double sense = area(path) < 0 ? -1 : 1;
    std::vector<Vec2> polygon;
    const std::size_t n = path.vertices.size();
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = sense > 0 ? k : n - 1 - k, next = sense > 0 ? (i + 1) % n : (i + n - 1) % n;
        polygon.push_back(path.vertices[i].point);
        const double bulge = sense > 0 ? path.vertices[i].bulge : -path.vertices[next].bulge;
        if (bulge != 0) {
            add_arc_outside(polygon, path.vertices[i].point, path.vertices[next].point, bulge, slack);
        }
    }
    return polygon;
}

Expected<Nesting> nest(const ReadOutline& outline, const NestOptions& options)
{
    NestOptions wider = options;
    wider.spacing += 2 * outline.strayed;
    wider.margin += outline.strayed;
    return nest(enclosing_polygon(outline.path, arc_slack), wider);
}

FileSet nesting_files(const ReadOutline& outline, const NestOptions& options, const Nesting& nesting)
{
    FileSet files;
    int first = 1;
    for (std::size_t i = 0; i < nesting.sheets.size(); ++i) {
        const Drawing drawing = drawing_of(outline, options, nesting, i, first);
        files[sheet_name(i) + ".svg"] = svg(drawing);
        files[sheet_name(i) + ".dxf"] = dxf(drawing);
        first += static_cast<int>(nesting.sheets[i].placements.size());
    }
    files["nesting.json"] = nesting_json(outline, options, nesting);
    return files;
}

std::string summary(const Nesting& nesting, const NestOptions& options)
{
    const auto size = [](double width, double height) {
        return to_fixed(width, 1) + " x " + to_fixed(height, 1) + " mm";
    };
    const Sheet& last = nesting.sheets.back();
    const Vec2 left = (last.offcut.max - last.offcut.min).cwiseMax(0.0);
    const bool with_remnant = nesting.sheets.front().remnant;
    const std::size_t whole = nesting.sheets.size() - (with_remnant ? 1 : 0);
    std::string text = std::to_string(options.count) + (options.count == 1 ? " copy on " : " copies on ");
    if (with_remnant) {
        text += "the remnant" + (whole > 0 ? " (" + std::to_string(nesting.sheets.front().placements.size()) + ") and "
                                           : std::string());
    }
    if (whole > 0) {
        text += std::to_string(whole) + (whole == 1 ? " sheet of " : " sheets of ") +
                size(options.sheet_width, options.sheet_height) + ", " + std::to_string(nesting.per_sheet) +
                " on a full one";
    }
    text += std::string(options.remnant && !with_remnant ? " (none fits on the remnant)" : "") + "; " +
            to_fixed(100 * nesting.utilisation, 1) + " % used";
    if (left.x() > 0 && left.y() > 0) {
        text += "; " + size(left.x(), left.y()) + " left over on the last";
    }
    return text;
}

} // namespace rhombloom
