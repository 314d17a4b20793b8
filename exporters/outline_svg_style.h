#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include "exporters/outline_svg_path.h"

//! What attributes and styles say about an SVG's nodes.
namespace rhombloom::reading {

inline constexpr double mm_per_px = 25.4 / 96;

//! \brief The node's name without the prefix of old Inkscape files ("svg:path").
std::string_view name_of(const pugi::xml_node& node);

//! \brief A length ("5mm", "12", "3px", "1e2cm") in CSS pixels, which are user units; nothing for percentages,
//! font sizes and nonsense.
std::optional<double> css_length(std::string_view text);

//! \brief A length of an attribute in user units; an absent one is 0.
Expected<double> user_length(const pugi::xml_node& node, const char* name);

//! \brief What `transform` or the style's transform says; the style has precedence.
Expected<Affine> transform_of(const pugi::xml_node& node);

//! \brief Where the user units of an `<svg>` or `<symbol>` with a viewBox lie in a viewport of this size, in CSS
//! pixels; a size that is absent follows from the other or is the viewBox's. Honours preserveAspectRatio.
Expected<Affine> viewport(const pugi::xml_node& node, std::optional<double> width, std::optional<double> height);

//! \brief The nodes inside \p svg in the order of the document; no recursion, so any depth will do.
template <class F>
void for_each_node(const pugi::xml_node& svg, F&& visit)
{
    for (pugi::xml_node node = svg.first_child(); node;) {
        visit(node);
        pugi::xml_node next = node.first_child();
        for (pugi::xml_node up = node; !next && up != svg; up = up.parent()) {
            next = up.next_sibling();
        }
        node = next;
    }
}

//! \brief Classes that the drawing's `<style>` elements do not show.
std::set<std::string> hidden_classes(const pugi::xml_node& svg);

//! \brief Not drawn: display none or visibility hidden, by attribute, style or class.
bool is_hidden(const pugi::xml_node& node, const std::set<std::string>& hidden);

} // namespace rhombloom::reading
