#include "core/design/design_file.h"

#include <algorithm>
#include <cmath>

#include "core/design/json_reader.h"
#include "core/design/operation_file.h"
#include "core/text.h"

namespace rhombloom {

using nlohmann::json;

namespace {

constexpr int max_operations = 10000;

Expected<Element> read_element(const json& value)
{
    Element element;
    ObjectReader reader(value, "$.element");
    element.la = reader.number("la_mm", element.la, 10, 1000);
    element.lb = reader.number("lb_mm", element.lb, 10, 1500);
    element.alpha = radians(reader.number("alpha_deg", degrees(element.alpha), 40, 85));
    element.thickness = reader.number("thickness_mm", element.thickness, 0.05, 5);
    if (auto ok = reader.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    if (auto ok = check(element); !ok) {
        return refuse("$.element: " + ok.error().message);
    }
    return element;
}

//! Degrees to ten decimals: what was read from a file is written again as it stood there.
double tidy_degrees(double angle)
{
    constexpr double ten_decimals = 1e10;
    return std::round(degrees(angle) * ten_decimals) / ten_decimals;
}

} // namespace

Expected<Design> parse_design(std::string_view text)
{
    auto root = parse_json(text);
    if (!root) {
        return tl::make_unexpected(root.error());
    }
    Design design;
    ObjectReader reader(*root, "$");
    reader.require("rhombloom");
    reader.require("operations");
    reader.integer("rhombloom", Design::version, 1, Design::version);
    design.title = reader.text("title", "");
    if (const json* element = reader.take("element")) {
        auto read = read_element(*element);
        read ? void(design.element = *read) : reader.fail(read.error());
    }
    if (const json* symmetry = reader.take("symmetry")) {
        auto read = read_symmetry(*symmetry, "$.symmetry");
        read ? void(design.symmetry = *read) : reader.fail(read.error());
    }
    const json* operations = reader.take("operations");
    if (operations != nullptr &&
        (!operations->is_array() || operations->empty() || operations->size() > max_operations)) {
        reader.fail("operations", "is " + describe(*operations) + ": expected a list of 1 to 10000 operations");
    }
    if (auto ok = reader.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    for (std::size_t i = 0; i < operations->size(); ++i) {
        auto operation = read_operation((*operations)[i], "$.operations[" + std::to_string(i) + "]");
        if (!operation) {
            return tl::make_unexpected(operation.error());
        }
        design.operations.push_back(std::move(*operation));
    }
    return design;
}

namespace {

bool is_plain(const nlohmann::ordered_json& value)
{
    return !value.is_structured() || value.empty();
}

//! Lists of lists of numbers fill lines; the rest is written as dump(2) does.
bool fills_lines(const nlohmann::ordered_json& value)
{
    const auto is_row = [](const auto& row) {
        return row.is_number() || (row.is_array() && std::all_of(row.begin(), row.end(), is_plain));
    };
    constexpr std::size_t many = 8;
    return value.is_array() && value.size() > many && std::all_of(value.begin(), value.end(), is_row);
}

std::string filled(const nlohmann::ordered_json& list, const std::string& indent)
{
    constexpr std::size_t width = 120;
    std::string text = "[";
    std::string line;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string item = list[i].dump() + (i + 1 < list.size() ? "," : "");
        if (!line.empty() && indent.size() + 3 + line.size() + item.size() > width) {
            text += "\n" + indent + "  " + line;
            line.clear();
        }
        line += (line.empty() ? "" : " ") + item;
    }
    return text + "\n" + indent + "  " + line + "\n" + indent + "]";
}

std::string tidy(const nlohmann::ordered_json& value, const std::string& indent)
{
    if (is_plain(value)) {
        return value.dump();
    }
    if (fills_lines(value)) {
        return filled(value, indent);
    }
    const bool is_list = value.is_array();
    std::string text;
    for (const auto& [key, item] : value.items()) {
        text += text.empty() ? "" : ",";
        text += "\n" + indent + "  " + (is_list ? "" : nlohmann::json(key).dump() + ": ") + tidy(item, indent + "  ");
    }
    return (is_list ? "[" : "{") + text + "\n" + indent + (is_list ? "]" : "}");
}

} // namespace

std::string write_design(const Design& design)
{
    nlohmann::ordered_json root;
    root["rhombloom"] = Design::version;
    root["title"] = design.title;
    root["element"] = {{"la_mm", design.element.la},
                       {"lb_mm", design.element.lb},
                       {"alpha_deg", tidy_degrees(design.element.alpha)},
                       {"thickness_mm", design.element.thickness}};
    if (design.symmetry.kind != Symmetry::Kind::None) {
        root["symmetry"] = write_symmetry(design.symmetry);
    }
    root["operations"] = nlohmann::ordered_json::array();
    for (const Operation& operation : design.operations) {
        root["operations"].push_back(write_operation(operation));
    }
    return tidy(root, "") + "\n";
}

std::string title_of(const std::string& file_stem)
{
    constexpr int most_characters = 80;
    // Written and read again, what is no UTF-8 has become U+FFFD.
    const auto replace = json::error_handler_t::replace;
    const std::string formed = json::parse(json(file_stem).dump(-1, ' ', false, replace)).get<std::string>();
    std::string title;
    int characters = 0;
    for (const char c : formed) {
        const auto byte = static_cast<unsigned char>(c);
        characters += continues_character(c) ? 0 : 1;
        if (characters > most_characters) {
            break;
        }
        title += byte < 0x20 || byte == 0x7F ? ' ' : c;
    }
    return title;
}

} // namespace rhombloom
