#include <cmath>
#include <map>

#include "exporters/pdf_embed_font.h"

#include "exporters/code_points.h"

namespace rhombloom {

namespace {

constexpr const char* font_name = "RHOMBL+DejaVuSansCondensed";

//! Characters by glyph, as PDF viewers search and copy them.
std::string unicode_map(const std::map<unsigned, char32_t>& characters)
{
    std::string map =
        "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n/CIDSystemInfo << /Registry (Adobe) "
        "/Ordering (UCS) /Supplement 0 >> def\n/CMapName /Adobe-Identity-UCS def\n/CMapType 2 def\n1 "
        "begincodespacerange\n<0000> <FFFF>\nendcodespacerange\n";
    constexpr std::size_t most = 100; // in one block
    std::size_t left = characters.size();
    std::size_t in_block = 0;
    for (const auto& [glyph, c] : characters) {
        if (in_block == 0) {
            in_block = std::min(most, left);
            map += std::to_string(in_block) + " beginbfchar\n";
        }
        std::string utf16 = hexadecimal(c);
        if (c > 0xFFFF) {
            utf16 = hexadecimal(0xD800 + ((c - 0x10000) >> 10)) + hexadecimal(0xDC00 + ((c - 0x10000) & 0x3FFU));
        }
        map += "<" + hexadecimal(glyph) + "> <" + utf16 + ">\n";
        --left;
        if (--in_block == 0) {
            map += "endbfchar\n";
        }
    }
    return map + "endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n";
}

std::string widths(const PdfFont& font, const std::map<unsigned, char32_t>& characters)
{
    std::string array = "[";
    unsigned next = 0;
    for (const auto& [glyph, c] : characters) {
        if (glyph != next || array.size() == 1) {
            array += (array.size() == 1 ? "" : "]") + std::to_string(glyph) + "[";
        }
        array += std::to_string(std::lround(1000 * font.glyph(c).advance)) + " ";
        next = glyph + 1;
    }
    return array + (array.size() == 1 ? "]" : "]]");
}

//! One bit for each glyph number: is it there?
std::string glyph_set(const std::map<unsigned, char32_t>& characters)
{
    std::string bits(1, '\x80');
    for (const auto& [glyph, c] : characters) {
        bits.resize(std::max<std::size_t>(bits.size(), glyph / 8 + 1), '\0');
        bits[glyph / 8] = static_cast<char>(bits[glyph / 8] | (0x80 >> glyph % 8));
    }
    return bits;
}

} // namespace

FontObjects font_objects(const PdfFont& font, const std::set<char32_t>& used)
{
    std::map<unsigned, char32_t> characters;
    for (const char32_t c : used) {
        characters.emplace(font.glyph(c).id, c);
    }
    const PdfFont::Measures m = font.measures();
    const std::string name = std::string("/") + font_name;
    FontObjects objects;
    objects.font = "<</Type/Font/Subtype/Type0/BaseFont" + name + "/Encoding/Identity-H>>";
    objects.glyphs = "<</Type/Font/Subtype/CIDFontType2/BaseFont" + name +
                     "/CIDSystemInfo<</Registry(Adobe)/Ordering(Identity)/Supplement 0>>/CIDToGIDMap/Identity/W" +
                     widths(font, characters) + ">>";
    objects.descriptor = "<</Type/FontDescriptor/FontName" + name + "/Flags 4/FontBBox[" + std::to_string(m.low_x) +
                         " " + std::to_string(m.low_y) + " " + std::to_string(m.high_x) + " " +
                         std::to_string(m.high_y) + "]/ItalicAngle 0/Ascent " + std::to_string(m.ascent) + "/Descent " +
                         std::to_string(m.descent) + "/CapHeight " + std::to_string(m.cap_height) + "/StemV 80>>";
    objects.unicode_map = unicode_map(characters);
    objects.glyph_set = glyph_set(characters);
    objects.file = font.subset(used);
    return objects;
}

} // namespace rhombloom
