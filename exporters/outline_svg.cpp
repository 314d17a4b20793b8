#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include <pugixml.hpp>

#include "core/units.h"
#include "exporters/outline_pieces.h"
#include "exporters/outline_svg_path.h"

namespace rhombloom::reading {

namespace {

constexpr double mm_per_px = 25.4 / 96;
constexpr int deepest = 200;

//! "600mm" in mm; plain numbers are CSS pixels. Nothing for percentages and nonsense.
std::optional<double> length_in_mm(std::string_view text)
{
    static const std::map<std::string_view, double> units = {{"", mm_per_px},  {"px", mm_per_px}, {"mm", 1},
                                                             {"cm", 10},       {"in", 25.4},      {"pt", 25.4 / 72},
                                                             {"pc", 25.4 / 6}, {"Q", 0.25}};
    const auto end = text.find_last_of("0123456789.");
    if (end == std::string_view::npos) {
        return {};
    }
    const auto number = svg_numbers(text.substr(0, end + 1));
    const auto unit = units.find(text.substr(end + 1));
    if (!number || number->size() != 1 || unit == units.end() || number->front() <= 0) {
        return {};
    }
    return number->front() * unit->second;
}

//! User units to mm with y up.
Expected<Affine> page(const pugi::xml_node& svg)
{
    const auto width = length_in_mm(svg.attribute("width").value());
    const auto height = length_in_mm(svg.attribute("height").value());
    const pugi::xml_attribute box = svg.attribute("viewBox");
    if (!box) {
        return Affine{mm_per_px, 0, 0, -mm_per_px, 0, height.value_or(0)};
    }
    const auto b = svg_numbers(box.value());
    if (!b || b->size() != 4 || !((*b)[2] > 0) || !((*b)[3] > 0)) {
        return refuse("the viewBox \"" + std::string(box.value()) + "\" should be four numbers, the last two above 0");
    }
    const double sx = width ? *width / (*b)[2] : height ? *height / (*b)[3] : mm_per_px;
    const double sy = height ? *height / (*b)[3] : sx;
    if (std::abs(sx - sy) > 1e-4 * sx) {
        return refuse("width, height and viewBox stretch the drawing unevenly; make their ratios equal");
    }
    return Affine{sx, 0, 0, -sx, -sx * (*b)[0], sx * ((*b)[1] + (*b)[3])};
}

Affine rotation(const std::vector<double>& n)
{
    const double a = radians(n[0]);
    const Affine turn{std::cos(a), std::sin(a), -std::sin(a), std::cos(a), 0, 0};
    return n.size() < 3 ? turn : Affine{1, 0, 0, 1, n[1], n[2]} * turn * Affine{1, 0, 0, 1, -n[1], -n[2]};
}

std::optional<Affine> one_transform(std::string_view name, const std::vector<double>& n)
{
    const std::size_t k = n.size();
    if (name == "matrix" && k == 6) {
        return Affine{n[0], n[1], n[2], n[3], n[4], n[5]};
    }
    if (name == "translate" && (k == 1 || k == 2)) {
        return Affine{1, 0, 0, 1, n[0], k == 2 ? n[1] : 0};
    }
    if (name == "scale" && (k == 1 || k == 2)) {
        return Affine{n[0], 0, 0, n[k - 1], 0, 0};
    }
    if (name == "rotate" && (k == 1 || k == 3)) {
        return rotation(n);
    }
    if ((name == "skewX" || name == "skewY") && k == 1) {
        const double t = std::tan(radians(n[0]));
        return name == "skewX" ? Affine{1, 0, t, 1, 0, 0} : Affine{1, t, 0, 1, 0, 0};
    }
    return {};
}

Expected<Affine> transform(std::string_view text)
{
    Affine result;
    while (true) {
        const auto start = text.find_first_not_of(" \t\r\n,");
        if (start == std::string_view::npos) {
            return result;
        }
        const auto open = text.find('(', start), close = text.find(')', start);
        if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
            return refuse("the transform \"" + std::string(text.substr(0, 60)) + "\" is malformed");
        }
        std::string_view name = text.substr(start, open - start);
        name = name.substr(0, name.find_last_not_of(" \t\r\n") + 1);
        const auto numbers = svg_numbers(text.substr(open + 1, close - open - 1));
        const auto one = numbers ? one_transform(name, *numbers) : std::nullopt;
        if (!one) {
            return refuse("the transform \"" + std::string(text.substr(start, close - start + 1)) + "\" is malformed");
        }
        result = result * *one;
        text.remove_prefix(close + 1);
    }
}

//! A number of an attribute in user units; an absent one is 0.
Expected<double> user_length(const pugi::xml_node& node, const char* name)
{
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) {
        return 0.0;
    }
    std::string_view text = attribute.value();
    if (text.ends_with("px")) {
        text.remove_suffix(2);
    }
    const auto numbers = svg_numbers(text);
    if (!numbers || numbers->size() != 1) {
        return refuse(std::string(node.name()) + " has " + name + "=\"" + attribute.value() + "\"; expected a number");
    }
    return numbers->front();
}

//! The shape as path data, so that one interpreter draws all of them.
struct Shape
{
    const pugi::xml_node& node;
    Pen& pen;

    template <std::size_t N>
    Expected<std::array<double, N>> lengths(const std::array<const char*, N>& names) const
    {
        std::array<double, N> values{};
        for (std::size_t i = 0; i < N; ++i) {
            const auto value = user_length(node, names[i]);
            if (!value) {
                return tl::make_unexpected(value.error());
            }
            values[i] = *value;
        }
        return values;
    }

    Expected<std::vector<Path>> corners(bool closed) const
    {
        const auto n = svg_numbers(node.attribute("points").value());
        if (!n || n->size() % 2 != 0) {
            return refuse(std::string(node.name()) + " has malformed points; expected pairs of numbers");
        }
        Path path{{}, closed, {}};
        for (std::size_t i = 0; i + 1 < n->size(); i += 2) {
            path.vertices.push_back({pen.to_mm * Vec2((*n)[i], (*n)[i + 1]), 0});
        }
        return std::vector<Path>{path};
    }

    Expected<std::vector<Path>> rectangle() const
    {
        const auto v = lengths<6>({"x", "y", "width", "height", "rx", "ry"});
        if (!v) {
            return tl::make_unexpected(v.error());
        }
        const auto [x, y, w, h, rx0, ry0] = *v;
        const double rx = std::min(rx0 > 0 ? rx0 : ry0, w / 2), ry = std::min(ry0 > 0 ? ry0 : rx0, h / 2);
        const SvgArc corner{rx, ry, 0, false, true};
        const std::array<Vec2, 8> p = {Vec2(x + rx, y),         Vec2(x + w - rx, y),     Vec2(x + w, y + ry),
                                       Vec2(x + w, y + h - ry), Vec2(x + w - rx, y + h), Vec2(x + rx, y + h),
                                       Vec2(x, y + h - ry),     Vec2(x, y + ry)};
        Path path{{{pen.to_mm * p[0], 0}}, true, {}};
        for (std::size_t i = 0; i < 8; i += 2) {
            path.vertices.push_back({pen.to_mm * p[i + 1], 0});
            add_svg_arc(path, p[i + 1], p[(i + 2) % 8], corner, pen);
        }
        return std::vector<Path>{path};
    }

    Expected<std::vector<Path>> round() const
    {
        const bool circle = std::string_view(node.name()) == "circle";
        const auto v = lengths<4>({"cx", "cy", circle ? "r" : "rx", circle ? "r" : "ry"});
        if (!v) {
            return tl::make_unexpected(v.error());
        }
        const auto [cx, cy, rx, ry] = *v;
        const Vec2 right(cx + rx, cy), left(cx - rx, cy);
        Path path{{{pen.to_mm * right, 0}}, true, {}};
        add_svg_arc(path, right, left, {rx, ry, 0, false, true}, pen);
        add_svg_arc(path, left, right, {rx, ry, 0, false, true}, pen);
        return std::vector<Path>{path};
    }

    Expected<std::vector<Path>> line() const
    {
        return lengths<4>({"x1", "y1", "x2", "y2"}).map([&](const std::array<double, 4>& v) {
            return std::vector<Path>{
                {{{pen.to_mm * Vec2(v[0], v[1]), 0}, {pen.to_mm * Vec2(v[2], v[3]), 0}}, false, {}}};
        });
    }

    Expected<std::vector<Path>> paths() const
    {
        const std::string_view name = node.name();
        if (name == "path") {
            return svg_path(node.attribute("d").value(), pen);
        }
        if (name == "polygon" || name == "polyline") {
            return corners(name == "polygon");
        }
        if (name == "rect") {
            return rectangle();
        }
        if (name == "circle" || name == "ellipse") {
            return round();
        }
        return name == "line" ? line() : Expected<std::vector<Path>>{};
    }
};

bool is_hidden(const pugi::xml_node& node)
{
    const std::string_view style = node.attribute("style").value();
    return std::string_view(node.attribute("display").value()) == "none" ||
           style.find("display:none") != std::string_view::npos ||
           style.find("display: none") != std::string_view::npos;
}

bool is_group(std::string_view name)
{
    return name == "g" || name == "svg" || name == "a" || name == "switch";
}

Expected<void> collect(const pugi::xml_node& parent, const Affine& to_mm, int depth, Pieces& pieces)
{
    if (depth > deepest) {
        return refuse("groups are nested more than " + std::to_string(deepest) + " deep");
    }
    for (const pugi::xml_node& node : parent.children()) {
        const std::string_view name = node.name();
        if (is_hidden(node)) {
            continue;
        }
        if (name == "use") {
            return refuse("the SVG draws a clone (<use>); unlink it first");
        }
        const auto own = transform(node.attribute("transform").value());
        if (!own) {
            return tl::make_unexpected(own.error());
        }
        Pen pen{to_mm * *own};
        if (is_group(name)) {
            if (auto ok = collect(node, pen.to_mm, depth + 1, pieces); !ok) {
                return ok;
            }
            continue;
        }
        auto paths = Shape{node, pen}.paths();
        if (!paths) {
            return tl::make_unexpected(paths.error());
        }
        pieces.paths.insert(pieces.paths.end(), paths->begin(), paths->end());
        pieces.curves |= pen.curves;
    }
    return {};
}

} // namespace

Expected<Pieces> svg_pieces(const std::string& bytes)
{
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
    if (!parsed) {
        return refuse("this is not valid XML near byte " + std::to_string(parsed.offset) + ": " + parsed.description());
    }
    const pugi::xml_node svg = document.child("svg");
    if (!svg) {
        return refuse("this is not an SVG: its root element is not <svg>");
    }
    const auto to_mm = page(svg);
    if (!to_mm) {
        return tl::make_unexpected(to_mm.error());
    }
    Pieces pieces;
    if (auto ok = collect(svg, *to_mm, 0, pieces); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return pieces;
}

} // namespace rhombloom::reading
