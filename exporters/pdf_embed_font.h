#pragma once

#include <set>
#include <string>

#include "exporters/pdf_font.h"

namespace rhombloom {

//! What a document needs to show some of a font's characters by their glyph numbers (two bytes each). The dictionaries
//! lack their references to each other.
struct FontObjects
{
    std::string font;        //!< dictionary
    std::string glyphs;      //!< dictionary of the descendant font
    std::string descriptor;  //!< dictionary
    std::string unicode_map; //!< stream
    std::string glyph_set;   //!< stream
    std::string file;        //!< stream
};

FontObjects font_objects(const PdfFont& font, const std::set<char32_t>& used);

} // namespace rhombloom
