#include "exporters/outline_svg_style.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.h"

namespace rhombloom::reading {

namespace {

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, last - first + 1);
}

//! The value of a property in the declarations "name: value; ..."; empty when it is not there.
std::string_view property(std::string_view declarations, std::string_view name)
{
    std::string_view found;
    while (!declarations.empty()) {
        const std::string_view one = declarations.substr(0, declarations.find(';'));
        declarations.remove_prefix(std::min(one.size() + 1, declarations.size()));
        const auto colon = one.find(':');
        if (colon != std::string_view::npos && trimmed(one.substr(0, colon)) == name) {
            found = trimmed(one.substr(colon + 1));
        }
    }
    return found;
}

bool hides(std::string_view declarations)
{
    const std::string_view visibility = property(declarations, "visibility");
    return property(declarations, "display").starts_with("none") || visibility.starts_with("hidden") ||
           visibility.starts_with("collapse");
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
        const std::string_view name = trimmed(text.substr(start, open - start));
        const auto numbers = svg_numbers(text.substr(open + 1, close - open - 1));
        const auto one = numbers ? one_transform(name, *numbers) : std::nullopt;
        if (!one) {
            return refuse("the transform \"" + std::string(text.substr(start, close - start + 1)) + "\" is malformed");
        }
        result = result * *one;
        text.remove_prefix(close + 1);
    }
}

//! A style's transform as an attribute would write it: lengths in pixels and angles in degrees without their units.
std::string without_units(std::string text)
{
    for (const std::string unit : {"px", "deg"}) {
        for (auto at = text.find(unit); at != std::string::npos; at = text.find(unit, at)) {
            text.erase(at, unit.size());
        }
    }
    return text;
}

//! Adds the classes that the rules of one style sheet hide.
void add_hidden(std::string_view sheet, std::set<std::string>& hidden)
{
    while (true) {
        const auto open = sheet.find('{'), close = sheet.find('}');
        if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
            return;
        }
        std::string_view selectors = sheet.substr(0, open);
        while (hides(sheet.substr(open + 1, close - open - 1)) && !selectors.empty()) {
            const std::string_view one = selectors.substr(0, selectors.find(','));
            selectors.remove_prefix(std::min(one.size() + 1, selectors.size()));
            const std::string_view name = trimmed(one);
            if (name.starts_with('.') && name.find_first_of(" >+~:[") == std::string_view::npos) {
                hidden.emplace(name.substr(1));
            }
        }
        sheet.remove_prefix(close + 1);
    }
}

} // namespace

std::string_view name_of(const pugi::xml_node& node)
{
    std::string_view name = node.name();
    if (name.starts_with("svg:")) {
        name.remove_prefix(4);
    }
    return name;
}

std::optional<double> css_length(std::string_view text)
{
    static const std::map<std::string_view, double> units = {{"", mm_per_px},  {"px", mm_per_px}, {"mm", 1},
                                                             {"cm", 10},       {"in", 25.4},      {"pt", 25.4 / 72},
                                                             {"pc", 25.4 / 6}, {"Q", 0.25}};
    text = trimmed(text);
    const auto end = text.find_last_of("0123456789.");
    if (end == std::string_view::npos) {
        return {};
    }
    const auto number = svg_numbers(text.substr(0, end + 1));
    const auto unit = units.find(trimmed(text.substr(end + 1)));
    if (!number || number->size() != 1 || unit == units.end()) {
        return {};
    }
    return number->front() * unit->second / mm_per_px;
}

Expected<double> user_length(const pugi::xml_node& node, const char* name)
{
    const pugi::xml_attribute attribute = node.attribute(name);
    const auto value = attribute ? css_length(attribute.value()) : std::optional(0.0);
    if (!value) {
        return refuse("<" + std::string(name_of(node)) + "> has " + name + "=\"" + attribute.value() +
                      "\"; expected a number or a length in px, mm, cm, in, pt or pc");
    }
    return *value;
}

Expected<Affine> transform_of(const pugi::xml_node& node)
{
    const std::string_view styled = property(node.attribute("style").value(), "transform");
    if (!styled.empty() && styled != "none") {
        return transform(without_units(std::string(styled)));
    }
    return transform(node.attribute("transform").value());
}

Expected<Affine> viewport(const pugi::xml_node& node, std::optional<double> width, std::optional<double> height)
{
    const pugi::xml_attribute box = node.attribute("viewBox");
    if (!box) {
        return Affine{};
    }
    const auto b = svg_numbers(box.value());
    if (!b || b->size() != 4 || !((*b)[2] > 0) || !((*b)[3] > 0)) {
        return refuse("the viewBox \"" + std::string(box.value()) + "\" should be four numbers, the last two above 0");
    }
    double sx = width ? *width / (*b)[2] : height ? *height / (*b)[3] : 1;
    double sy = height ? *height / (*b)[3] : sx;
    const std::string_view fit = node.attribute("preserveAspectRatio").value();
    if (fit.find("none") == std::string_view::npos && std::abs(sx - sy) > 1e-4 * sx) {
        sx = sy = fit.find("slice") == std::string_view::npos ? std::min(sx, sy) : std::max(sx, sy);
    } else if (std::abs(sx - sy) <= 1e-4 * sx) {
        sy = sx; // rounded sizes
    }
    return Affine{sx, 0, 0, sy, -sx * (*b)[0], -sy * (*b)[1]};
}

std::set<std::string> hidden_classes(const pugi::xml_node& svg)
{
    std::set<std::string> hidden;
    for_each_node(svg, [&](const pugi::xml_node& node) {
        if (name_of(node) == "style") {
            for (const pugi::xml_node& text : node.children()) {
                add_hidden(text.value(), hidden);
            }
        }
    });
    return hidden;
}

bool is_hidden(const pugi::xml_node& node, const std::set<std::string>& hidden)
{
    const std::string_view visibility = node.attribute("visibility").value();
    if (std::string_view(node.attribute("display").value()) == "none" || visibility == "hidden" ||
        visibility == "collapse" || hides(node.attribute("style").value())) {
        return true;
    }
    std::string_view classes = node.attribute("class").value();
    while (!hidden.empty() && !classes.empty()) {
        const std::string_view one = classes.substr(0, classes.find(' '));
        classes.remove_prefix(std::min(one.size() + 1, classes.size()));
        if (hidden.contains(std::string(one))) {
            return true;
        }
    }
    return false;
}

} // namespace rhombloom::reading
