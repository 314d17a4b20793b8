#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include <pugixml.hpp>

#include "exporters/outline_pieces.h"
#include "exporters/outline_svg_style.h"

namespace rhombloom::reading {

namespace {

constexpr int deepest = 200;
constexpr int most_nodes = 200000; // drawn, those of clones counted each time

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
            return refuse(std::string(name_of(node)) + " has malformed points; expected pairs of numbers");
        }
        Path path{{}, closed, {}};
        for (std::size_t i = 0; i + 1 < n->size(); i += 2) {
            path.vertices.push_back({pen.to_mm * Vec2((*n)[i], (*n)[i + 1]), 0});
        }
        return std::vector<Path>{path};
    }

    //! What has no size is not drawn; a negative one is an error.
    Expected<std::vector<Path>> drawn_only_if(bool no_error) const
    {
        if (!no_error) {
            return refuse("a <" + std::string(name_of(node)) + "> has a negative size");
        }
        return std::vector<Path>{};
    }

    Expected<std::vector<Path>> rectangle() const
    {
        const auto v = lengths<6>({"x", "y", "width", "height", "rx", "ry"});
        if (!v) {
            return tl::make_unexpected(v.error());
        }
        const auto [x, y, w, h, rx0, ry0] = *v;
        if (!(w > 0 && h > 0)) {
            return drawn_only_if(w >= 0 && h >= 0);
        }
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
        const bool circle = name_of(node) == "circle";
        const auto v = lengths<4>({"cx", "cy", circle ? "r" : "rx", circle ? "r" : "ry"});
        if (!v) {
            return tl::make_unexpected(v.error());
        }
        const auto [cx, cy, rx, ry] = *v;
        if (!(rx > 0 && ry > 0)) {
            return drawn_only_if(rx >= 0 && ry >= 0);
        }
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
        const std::string_view name = name_of(node);
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

bool is_group(std::string_view name)
{
    return name == "g" || name == "svg" || name == "a" || name == "switch";
}

//! Walks the drawing, clones included.
class Collector
{
public:
    explicit Collector(const pugi::xml_node& svg) : hidden_(hidden_classes(svg))
    {
        for_each_node(svg, [&](const pugi::xml_node& node) {
            if (const pugi::xml_attribute id = node.attribute("id")) {
                named_.emplace(id.value(), node);
            }
        });
    }

    Expected<void> children(const pugi::xml_node& parent, const Affine& to_mm, int depth);
    Pieces pieces;

private:
    Expected<void> node(const pugi::xml_node& node, const Affine& to_mm, int depth);
    Expected<void> clone(const pugi::xml_node& use, const Affine& to_mm, int depth);
    Expected<void> nested(const pugi::xml_node& node, const pugi::xml_node& sized, const Affine& to_mm, int depth);

    std::set<std::string> hidden_;
    std::map<std::string, pugi::xml_node> named_;
    int nodes_ = 0;
};

Expected<void> Collector::children(const pugi::xml_node& parent, const Affine& to_mm, int depth)
{
    if (depth > deepest) {
        return refuse("groups or clones are nested more than " + std::to_string(deepest) + " deep");
    }
    for (const pugi::xml_node& child : parent.children()) {
        if (++nodes_ > most_nodes) {
            return refuse("the SVG draws more than " + std::to_string(most_nodes) + " objects");
        }
        if (auto ok = is_hidden(child, hidden_) ? Expected<void>{} : node(child, to_mm, depth); !ok) {
            return ok;
        }
    }
    return {};
}

Expected<void> Collector::node(const pugi::xml_node& node, const Affine& to_mm, int depth)
{
    const std::string_view name = name_of(node);
    const auto own = transform_of(node);
    if (!own) {
        return tl::make_unexpected(own.error());
    }
    Pen pen{to_mm * *own};
    if (name == "svg") {
        return nested(node, node, pen.to_mm, depth);
    }
    if (is_group(name)) {
        return children(node, pen.to_mm, depth + 1);
    }
    if (name == "use") {
        return clone(node, pen.to_mm, depth);
    }
    auto paths = Shape{node, pen}.paths();
    if (!paths) {
        return tl::make_unexpected(paths.error());
    }
    pieces.paths.insert(pieces.paths.end(), paths->begin(), paths->end());
    pieces.curves |= pen.curves;
    return {};
}

//! An inner <svg>, or the <symbol> of a clone, which has its size from the clone.
Expected<void> Collector::nested(const pugi::xml_node& node, const pugi::xml_node& sized, const Affine& to_mm,
                                 int depth)
{
    const auto x = user_length(sized, "x"), y = user_length(sized, "y");
    const auto width = css_length(sized.attribute("width").value()),
               height = css_length(sized.attribute("height").value());
    if (!x || !y) {
        return tl::make_unexpected((x ? y : x).error());
    }
    if (node.attribute("viewBox") && !(width && height && *width > 0 && *height > 0)) {
        return refuse("an inner <" + std::string(name_of(node)) +
                      "> has a viewBox but no size in units; give it width and height, or ungroup it");
    }
    const auto inside = viewport(node, width, height);
    if (!inside) {
        return tl::make_unexpected(inside.error());
    }
    return children(node, to_mm * Affine{1, 0, 0, 1, *x, *y} * *inside, depth + 1);
}

Expected<void> Collector::clone(const pugi::xml_node& use, const Affine& to_mm, int depth)
{
    const pugi::xml_attribute plain = use.attribute("href");
    const std::string link = plain ? plain.value() : use.attribute("xlink:href").value();
    const auto found = link.starts_with('#') ? named_.find(link.substr(1)) : named_.end();
    const pugi::xml_node drawn = found == named_.end() ? pugi::xml_node{} : found->second;
    if (!drawn || depth > deepest || ++nodes_ > most_nodes) {
        return refuse("the clone (<use>) of \"" + link.substr(0, 60) +
                      "\" cannot be drawn: " + (drawn ? "it draws itself" : "the drawing holds nothing of that name"));
    }
    if (name_of(drawn) == "symbol") {
        return nested(drawn, use, to_mm, depth + 1);
    }
    const auto x = user_length(use, "x"), y = user_length(use, "y");
    if (!x || !y) {
        return tl::make_unexpected((x ? y : x).error());
    }
    return is_hidden(drawn, hidden_) ? Expected<void>{} : node(drawn, to_mm * Affine{1, 0, 0, 1, *x, *y}, depth + 1);
}

//! User units to mm with y up.
Expected<Affine> page(const pugi::xml_node& svg)
{
    const auto size = [&](const char* name) -> Expected<std::optional<double>> {
        const std::string_view text = svg.attribute(name).value();
        const auto length = css_length(text);
        if (text.empty() || text.ends_with('%') || text == "auto" || (length && *length > 0)) {
            return length;
        }
        return refuse("the SVG's " + std::string(name) + " is \"" + std::string(text) +
                      "\"; expected a length above 0 in mm, cm, in, px, pt or pc");
    };
    const auto width = size("width"), height = size("height");
    if (!width || !height) {
        return tl::make_unexpected((width ? height : width).error());
    }
    return viewport(svg, *width, *height).map([&](const Affine& to_px) {
        return Affine{mm_per_px, 0, 0, -mm_per_px, 0, mm_per_px * height->value_or(0)} * to_px;
    });
}

} // namespace

Expected<Pieces> svg_pieces(const std::string& bytes)
{
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
    if (!parsed) {
        return refuse("this is not valid XML near byte " + std::to_string(parsed.offset) + ": " + parsed.description());
    }
    const pugi::xml_node svg = document.document_element();
    if (name_of(svg) != "svg") {
        return refuse("this is not an SVG: its root element is not <svg>");
    }
    const auto to_mm = page(svg);
    if (!to_mm) {
        return tl::make_unexpected(to_mm.error());
    }
    Collector collector(svg);
    if (auto ok = collector.children(svg, *to_mm, 0); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return std::move(collector.pieces);
}

} // namespace rhombloom::reading
