#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "core/units.h"
#include "exporters/outline_pieces.h"

namespace rhombloom::reading {

namespace {

//! A line pair of the file.
struct Group
{
    int code = 0;
    std::string_view value;
    std::size_t line = 0;
};

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t\r");
    const auto last = text.find_last_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, last - first + 1);
}

Expected<std::vector<Group>> groups_of(std::string_view bytes)
{
    if (bytes.starts_with("AutoCAD Binary DXF")) {
        return refuse("this is a binary DXF; save it as ASCII DXF (R12 or 2000)");
    }
    std::vector<Group> groups;
    std::size_t line = 0;
    std::optional<int> code;
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        const std::string_view text = trimmed(bytes.substr(0, end));
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        ++line;
        if (code) {
            groups.push_back({*code, text, line});
            code.reset();
            continue;
        }
        int value = 0;
        const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || rest != text.data() + text.size()) {
            if (text.empty() && bytes.empty()) {
                break;
            }
            return refuse("line " + std::to_string(line) + " should be a DXF group code (a whole number)");
        }
        code = value;
    }
    return groups;
}

//! One entity: its kind and its groups.
struct Entity
{
    std::string_view kind;
    std::vector<Group> groups;
};

double number(const Group& group)
{
    std::string_view text = group.value;
    if (text.starts_with('+')) {
        text.remove_prefix(1);
    }
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && rest == text.data() + text.size() ? value : std::nan("");
}

double value_of(const Entity& entity, int code, double otherwise)
{
    for (const Group& group : entity.groups) {
        if (group.code == code) {
            return number(group);
        }
    }
    return otherwise;
}

//! A flag word; what is no small whole number counts as 0.
int whole(double value)
{
    return std::isfinite(value) && std::abs(value) < 1e6 ? static_cast<int>(value) : 0;
}

Vec2 point_of(const Entity& entity, int code)
{
    return {value_of(entity, code, std::nan("")), value_of(entity, code + 10, std::nan(""))};
}

//! The entities of the ENTITIES section; in blocks and paper space nothing is looked at.
std::vector<Entity> entities_of(const std::vector<Group>& groups)
{
    std::vector<Entity> entities;
    bool inside = false;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const Group& g = groups[i];
        if (g.code == 0 && g.value == "ENDSEC") {
            inside = false;
        } else if (g.code == 2 && g.value == "ENTITIES" && i > 0 && groups[i - 1].value == "SECTION") {
            inside = true;
        } else if (inside && g.code == 0) {
            entities.push_back({g.value, {}});
        } else if (inside && !entities.empty()) {
            entities.back().groups.push_back(g);
        }
    }
    return entities;
}

//! Vertices of an LWPOLYLINE: 10, 20 and 42 in turn.
Path light_polyline(const Entity& entity)
{
    Path path;
    path.closed = (whole(value_of(entity, 70, 0)) & 1) != 0;
    for (const Group& g : entity.groups) {
        if (g.code == 10) {
            path.vertices.push_back({Vec2(number(g), std::nan("")), 0});
        } else if (g.code == 20 && !path.vertices.empty()) {
            path.vertices.back().point.y() = number(g);
        } else if (g.code == 42 && !path.vertices.empty()) {
            path.vertices.back().bulge = number(g);
        }
    }
    return path;
}

//! Bulges beyond 1 (more than half a circle) are split.
Path with_short_arcs(const Path& path)
{
    Path result;
    result.closed = path.closed;
    const std::size_t n = path.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
        result.vertices.push_back(path.vertices[i]);
        const double bulge = path.vertices[i].bulge;
        const bool last = i + 1 == n;
        if (std::abs(bulge) > 1 && (!last || path.closed)) {
            add_arc(result, path.vertices[(i + 1) % n].point, 4 * std::atan(bulge));
            result.vertices.pop_back();
        }
    }
    return result;
}

Path line(const Entity& entity)
{
    return {{{point_of(entity, 10), 0}, {point_of(entity, 11), 0}}, false, {}};
}

Path arc(const Entity& entity)
{
    const Vec2 centre = point_of(entity, 10);
    const double r = value_of(entity, 40, std::nan(""));
    const double start = radians(value_of(entity, 50, 0));
    double sweep = radians(value_of(entity, 51, 0)) - start;
    sweep -= two_pi * std::floor(sweep / two_pi);
    const auto at = [&](double a) { return Vec2(centre + r * Vec2(std::cos(a), std::sin(a))); };
    Path path{{{at(start), 0}}, false, {}};
    add_arc(path, at(start + sweep), sweep);
    return path;
}

Path circle(const Entity& entity)
{
    const Vec2 centre = point_of(entity, 10), r(value_of(entity, 40, std::nan("")), 0);
    return {{{centre + r, 1}, {centre - r, 1}}, true, {}};
}

//! Entities with an extrusion of -z are drawn mirrored in the y axis.
Path as_seen(Path path, const Entity& entity)
{
    if (value_of(entity, 230, 1) < 0) {
        for (PathVertex& v : path.vertices) {
            v.point.x() = -v.point.x();
            v.bulge = -v.bulge;
        }
    }
    return path;
}

Expected<void> add_entity(const std::vector<Entity>& entities, std::size_t& i, std::vector<Path>& paths)
{
    static const std::set<std::string_view> curves = {"SPLINE", "ELLIPSE", "INSERT", "MLINE", "REGION"};
    const Entity& entity = entities[i];
    if (curves.contains(entity.kind)) {
        return refuse("the DXF holds a " + std::string(entity.kind) +
                      "; expected polylines, lines, arcs and circles (explode blocks, convert splines to arcs)");
    }
    if (entity.kind == "LINE") {
        paths.push_back(line(entity)); // LINE is in world coordinates whatever its extrusion
    } else if (entity.kind == "ARC") {
        paths.push_back(as_seen(arc(entity), entity));
    } else if (entity.kind == "CIRCLE") {
        paths.push_back(as_seen(circle(entity), entity));
    } else if (entity.kind == "LWPOLYLINE") {
        paths.push_back(as_seen(with_short_arcs(light_polyline(entity)), entity));
    } else if (entity.kind == "POLYLINE") {
        Path path;
        path.closed = (whole(value_of(entity, 70, 0)) & 1) != 0;
        for (; i + 1 < entities.size() && entities[i + 1].kind == "VERTEX"; ++i) {
            path.vertices.push_back({point_of(entities[i + 1], 10), value_of(entities[i + 1], 42, 0)});
        }
        paths.push_back(as_seen(with_short_arcs(path), entity));
    }
    return {};
}

Expected<double> millimetres_per_unit(const std::vector<Group>& groups)
{
    for (std::size_t i = 0; i + 1 < groups.size(); ++i) {
        if (groups[i].code != 9 || groups[i].value != "$INSUNITS") {
            continue;
        }
        switch (whole(number(groups[i + 1]))) {
        case 0:
        case 4:
            return 1.0;
        case 1:
            return 25.4;
        case 2:
            return 304.8;
        case 5:
            return 10.0;
        case 6:
            return 1000.0;
        default:
            return refuse("$INSUNITS is " + std::string(groups[i + 1].value) +
                          "; expected 0 or 4 (mm), 1 (inches), 2 (feet), 5 (cm) or 6 (m)");
        }
    }
    return 1.0;
}

} // namespace

Expected<Pieces> dxf_pieces(const std::string& bytes)
{
    const auto groups = groups_of(bytes);
    if (!groups) {
        return tl::make_unexpected(groups.error());
    }
    const auto unit = millimetres_per_unit(*groups);
    if (!unit) {
        return tl::make_unexpected(unit.error());
    }
    const std::vector<Entity> entities = entities_of(*groups);
    Pieces pieces;
    for (std::size_t i = 0; i < entities.size(); ++i) {
        if (auto ok = add_entity(entities, i, pieces.paths); !ok) {
            return tl::make_unexpected(ok.error());
        }
    }
    for (Path& path : pieces.paths) {
        for (PathVertex& v : path.vertices) {
            v.point *= *unit;
        }
    }
    return pieces;
}

} // namespace rhombloom::reading
