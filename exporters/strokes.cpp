#include "exporters/strokes.h"

#include <utility>

namespace rhombloom {

namespace {

constexpr double grid_width = 4, grid_height = 6, grid_advance = 5.5, grid_underline = -1.25;

// A glyph lives on a grid 4 wide and 6 high. A vertex is two digits, x and y, followed by the arc that leads on:
// ( and ) are quarter circles counter-clockwise and clockwise, < and > half circles. A bar starts the next stroke.
constexpr std::pair<char, const char*> glyphs[] = {
    {'0', "02<42 44<04 02"},
    {'1', "15 26 20"},
    {'2', "04>44)22(00 40"},
    {'3', "06 46 24>20 00"},
    {'4', "30 36 02 42"},
    {'5', "46 06 04 24>20 00"},
    {'6', "46(02<42<02"},
    {'7', "06 46 10"},
    {'8', "23<26<23>20>23"},
    {'9', "00(44<04<44"},
    {'A', "00 26 40|12 32"},
    {'B', "00 06 26>23 03|23>20 00"},
    {'C', "44<04 02<42"},
    {'D', "00 06 16)43)10 00"},
    {'E', "46 06 00 40|03 33"},
    {'F', "46 06 00|03 33"},
    {'G', "44<04 02<42 43 23"},
    {'H', "00 06|40 46|03 43"},
    {'I', "20 26"},
    {'J', "46 42>02"},
    {'K', "00 06|46 03 40"},
    {'L', "06 00 40"},
    {'M', "00 06 22 46 40"},
    {'N', "00 06 40 46"},
    {'O', "02<42 44<04 02"},
    {'P', "00 06 26>23 03"},
    {'Q', "02<42 44<04 02|21 40"},
    {'R', "00 06 26>23 03|23 40"},
    {'S', "46 26<23>20 00"},
    {'T', "20 26|06 46"},
    {'U', "06 02<42 46"},
    {'V', "06 20 46"},
    {'W', "06 10 24 30 46"},
    {'X', "00 46|06 40"},
    {'Y', "06 23 46|23 20"},
    {'Z', "06 46 00 40"},
    {'/', "00 46"},
    {'.', "20 21"},
    {'-', "13 33"},
    {':', "21 22|24 25"},
    {'%', "00 46|05<15<05|31<41<31"},
    {'+', "03 43|21 25"},
    {'x', "00 44|04 40"},
    {'=', "02 42|04 44"},
};

constexpr double quarter = 0.41421356237309503; // tan(90 degrees / 4)

double bulge(char arc)
{
    switch (arc) {
    case '(':
        return quarter;
    case ')':
        return -quarter;
    case '<':
        return 1;
    case '>':
        return -1;
    default:
        return 0;
    }
}

std::vector<Path> glyph_strokes(const char* code, double unit, double left)
{
    std::vector<Path> result(1, Path{{}, false});
    for (; *code != '\0'; ++code) {
        if (*code == '|') {
            result.push_back({{}, false});
        } else if (*code >= '0' && *code <= '9') {
            const Vec2 point(left + (code[0] - '0') * unit, (code[1] - '0') * unit);
            result.back().vertices.push_back({point, 0});
            ++code;
        } else if (*code != ' ') {
            result.back().vertices.back().bulge = bulge(*code);
        }
    }
    return result;
}

Path underline(double unit, double left)
{
    const double y = grid_underline * unit;
    return {{{Vec2(left, y), 0}, {Vec2(left + grid_width * unit, y), 0}}, false};
}

} // namespace

std::vector<Path> strokes(std::string_view text, double height, SixNine six_nine)
{
    const double unit = height / grid_height;
    std::vector<Path> result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const double left = static_cast<double>(i) * grid_advance * unit;
        for (const auto& [name, code] : glyphs) {
            if (name == text[i]) {
                const std::vector<Path> glyph = glyph_strokes(code, unit, left);
                result.insert(result.end(), glyph.begin(), glyph.end());
            }
        }
        if (six_nine == SixNine::Underlined && (text[i] == '6' || text[i] == '9')) {
            result.push_back(underline(unit, left));
        }
    }
    return result;
}

double strokes_width(std::string_view text, double height)
{
    const double count = static_cast<double>(text.size());
    return text.empty() ? 0 : ((count - 1) * grid_advance + grid_width) * height / grid_height;
}

} // namespace rhombloom
