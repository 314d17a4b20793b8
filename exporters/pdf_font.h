#pragma once

#include <memory>
#include <set>
#include <string>

#include "core/expected.h"

namespace rhombloom {

//! \brief A TrueType font, of which a document embeds the characters it uses. May be asked from several threads.
class PdfFont
{
public:
    struct Glyph
    {
        unsigned id = 0;    //!< 0: the font has no such character
        double advance = 0; //!< in parts of the font's size
    };

    //! Measures as a font descriptor has them: 1000 = the font's size.
    struct Measures
    {
        int ascent = 0;
        int descent = 0;
        int cap_height = 0;
        int low_x = 0, low_y = 0, high_x = 0, high_y = 0; //!< box of all glyphs
    };

    //! \brief Refuses a file that is no font.
    static Expected<std::shared_ptr<const PdfFont>> load(const std::string& file);

    ~PdfFont();
    PdfFont(const PdfFont&) = delete;
    PdfFont& operator=(const PdfFont&) = delete;

    Glyph glyph(char32_t character) const;

    //! \brief Can it be drawn, one character after the other from the left? Not what the font lacks, nor Hebrew or
    //! Arabic, which are written from the right.
    bool writes(char32_t character) const;
    Measures measures() const;

    //! \brief The font file with only these characters and glyph 0; glyphs keep their numbers.
    std::string subset(const std::set<char32_t>& characters) const;

private:
    struct State;
    explicit PdfFont(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace rhombloom
