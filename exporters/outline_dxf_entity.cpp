#include "exporters/outline_dxf_entity.h"

#include <charconv>
#include <cmath>
#include <string>

namespace rhombloom::reading {

namespace {

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t\r");
    const auto last = text.find_last_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, last - first + 1);
}

} // namespace

Expected<std::vector<DxfGroup>> dxf_groups(std::string_view bytes)
{
    if (bytes.starts_with("AutoCAD Binary DXF")) {
        return refuse("this is a binary DXF; save it as ASCII DXF (R12 or 2000)");
    }
    if (bytes.starts_with("\xEF\xBB\xBF")) {
        bytes.remove_prefix(3); // byte order mark
    }
    std::vector<DxfGroup> groups;
    std::size_t line = 0;
    bool awaits_value = false;
    int code = 0;
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        const std::string_view text = trimmed(bytes.substr(0, end));
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        ++line;
        if (awaits_value) {
            groups.push_back({code, text});
            if (code == 0 && text == "EOF") {
                return groups;
            }
            awaits_value = false;
            continue;
        }
        const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), code);
        if (error != std::errc{} || rest != text.data() + text.size()) {
            if (text.empty() && bytes.empty()) {
                break;
            }
            return refuse("line " + std::to_string(line) + " should be a DXF group code (a whole number)");
        }
        awaits_value = true;
    }
    return refuse("the file breaks off before its end (EOF): what it draws may be incomplete; export it again");
}

std::vector<DxfEntity> dxf_entities(const std::vector<DxfGroup>& groups, std::string_view section)
{
    std::vector<DxfEntity> entities;
    bool inside = false;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const DxfGroup& g = groups[i];
        if (g.code == 0 && g.value == "ENDSEC") {
            inside = false;
        } else if (g.code == 2 && g.value == section && i > 0 && groups[i - 1].value == "SECTION") {
            inside = true;
        } else if (inside && g.code == 0) {
            entities.push_back({g.value, {}});
        } else if (inside && !entities.empty()) {
            entities.back().groups.push_back(g);
        }
    }
    return entities;
}

double dxf_number(const DxfGroup& group)
{
    std::string_view text = group.value;
    if (text.starts_with('+')) {
        text.remove_prefix(1);
    }
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && rest == text.data() + text.size() ? value : std::nan("");
}

double dxf_value(const DxfEntity& entity, int code, double otherwise)
{
    for (const DxfGroup& group : entity.groups) {
        if (group.code == code) {
            return dxf_number(group);
        }
    }
    return otherwise;
}

std::string_view dxf_text(const DxfEntity& entity, int code)
{
    for (const DxfGroup& group : entity.groups) {
        if (group.code == code) {
            return group.value;
        }
    }
    return {};
}

Vec2 dxf_point(const DxfEntity& entity, int code)
{
    return {dxf_value(entity, code, std::nan("")), dxf_value(entity, code + 10, std::nan(""))};
}

} // namespace rhombloom::reading
