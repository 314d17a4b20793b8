#include "apps/studio/session/shelf.h"

#include <cstdlib>

#include "core/design/json_reader.h"
#include "core/design/operation_file.h"
#include "exporters/save.h"

namespace rhombloom::studio {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

constexpr std::size_t max_bytes = 16'000'000;
constexpr std::size_t most_layouts = 200;

Expected<ordered_json> read_layout(const json& value, const std::string& path)
{
    ObjectReader reader(value, path);
    reader.require("name");
    const std::string name = reader.text("name", "");
    json operation = {{"op", "layout"}, {"id", name}};
    for (const char* key : {"elements", "joins"}) {
        const json* list = reader.take(key);
        operation[key] = list == nullptr ? json::array() : *list;
    }
    if (auto ok = reader.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    const auto layout = read_operation(operation, path);
    if (!layout) {
        return tl::make_unexpected(layout.error());
    }
    const ordered_json written = write_operation(*layout);
    return ordered_json{{"name", name}, {"elements", written["elements"]}, {"joins", written["joins"]}};
}

Expected<ordered_json> read_layouts(const json& list)
{
    if (!list.is_array() || list.size() > most_layouts) {
        return refuse("$.layouts is " + describe(list) + ": expected a list of at most 200 layouts");
    }
    ordered_json result = ordered_json::array();
    for (std::size_t i = 0; i < list.size(); ++i) {
        auto layout = read_layout(list[i], "$.layouts[" + std::to_string(i) + "]");
        if (!layout) {
            return layout;
        }
        result.push_back(std::move(*layout));
    }
    return result;
}

} // namespace

ordered_json Shelf::layouts() const
{
    const auto bytes = load_file(path_, max_bytes);
    const auto root = bytes ? parse_json(*bytes) : Expected<json>(json());
    if (!root || !root->is_object() || !root->contains("layouts")) {
        return ordered_json::array();
    }
    const auto list = read_layouts((*root)["layouts"]);
    return list ? *list : ordered_json::array();
}

Expected<void> Shelf::keep(const json& layouts)
{
    const auto list = read_layouts(layouts);
    if (!list) {
        return tl::make_unexpected(list.error());
    }
    const std::size_t slash = path_.rfind('/');
    return save_folder(path_.substr(0, slash),
                       {{path_.substr(slash + 1), ordered_json{{"layouts", *list}}.dump(1) + "\n"}});
}

std::string default_shelf_path()
{
    const char* data = std::getenv("XDG_DATA_HOME");
    const char* home = std::getenv("HOME");
    const std::string base = data != nullptr && data[0] == '/' ? std::string(data)
                             : home != nullptr                 ? std::string(home) + "/.local/share"
                                                               : std::string(".");
    return base + "/rhombloom/layouts.json";
}

} // namespace rhombloom::studio
