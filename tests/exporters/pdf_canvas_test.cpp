#include "exporters/pdf_canvas.h"

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

const PdfFont& font()
{
    static const auto loaded = PdfFont::load(RHOMBLOOM_SOURCE_DIR "/templates/fonts/DejaVuSansCondensed.ttf");
    return **loaded;
}

std::string together(const std::vector<std::string>& lines)
{
    std::string text;
    for (const std::string& line : lines) {
        text += line;
    }
    return text;
}

TEST(PdfCanvas, BreaksLinesAtSpaces)
{
    const PdfCanvas canvas(font());
    const double width = canvas.text_width("a lamp for", 10) + 1;
    EXPECT_EQ(canvas.lines("a lamp for the hall", width, 10), (std::vector<std::string>{"a lamp for", "the hall"}));
}

TEST(PdfCanvas, BreaksAWordThatIsWiderThanTheLineBetweenCharacters)
{
    const PdfCanvas canvas(font());
    std::string word;
    for (int k = 0; k < 60; ++k) {
        word += "\u00FC";
    }
    const auto lines = canvas.lines(word, 100, 12);
    EXPECT_GT(lines.size(), 3U);
    EXPECT_EQ(together(lines), word);
    for (const std::string& line : lines) {
        EXPECT_LE(canvas.text_width(line, 12), 100);
        EXPECT_EQ(line.size() % 2, 0U);
    }
}

TEST(PdfCanvas, LinesEndThoughNotOneCharacterFits)
{
    const PdfCanvas canvas(font());
    EXPECT_EQ(together(canvas.lines("wide", 1, 12)), "wide");
}

TEST(PdfCanvas, AFittingSizeFits)
{
    const PdfCanvas canvas(font());
    EXPECT_EQ(canvas.fitting_size("body", 500, 24), 24);
    const std::string name = "the body with a really long name that somebody gave it because they could";
    EXPECT_LE(canvas.text_width(name, canvas.fitting_size(name, 500, 24)), 500 + 1e-9);
}

} // namespace
} // namespace rhombloom
