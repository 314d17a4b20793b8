#include "exporters/template_pdf.h"

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

std::size_t pages(const std::string& pdf)
{
    const std::string word = "/Count ";
    const std::size_t at = pdf.find(word);
    return at == std::string::npos ? 0 : std::stoul(pdf.substr(at + word.size()));
}

Expected<std::string> pdf_for(double la, Paper paper)
{
    Element element;
    element.la = la;
    element.lb = 1.1 * la;
    return element_outline(hook_parameters(element)).and_then([&](const Path& outline) {
        return template_pdf(outline, paper);
    });
}

TEST(TemplatePdf, OfASmallPieceIsOnePage)
{
    const auto pdf = pdf_for(80, Paper::A4);
    ASSERT_TRUE(pdf) << pdf.error().message;
    EXPECT_EQ(pdf->substr(0, 8), "%PDF-1.5");
    EXPECT_EQ(pages(*pdf), 1U);
}

TEST(TemplatePdf, OfALargePieceIsTiledBehindAPlan)
{
    const auto pdf = pdf_for(200, Paper::Letter);
    ASSERT_TRUE(pdf) << pdf.error().message;
    EXPECT_EQ(pages(*pdf), 3U);
}

TEST(TemplatePdf, HasTheSameBytesEveryTimeAndNoFont)
{
    EXPECT_EQ(*pdf_for(60, Paper::Letter), *pdf_for(60, Paper::Letter));
    EXPECT_EQ(pdf_for(60, Paper::Letter)->find("/Font"), std::string::npos);
}

} // namespace
} // namespace rhombloom
