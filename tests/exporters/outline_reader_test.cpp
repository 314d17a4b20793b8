#include "exporters/outline_reader.h"

#include <gtest/gtest.h>

#include "core/units.h"

namespace rhombloom {
namespace {

double area_read(const std::string& name, const std::string& bytes)
{
    const auto outline = read_outline(name, bytes);
    EXPECT_TRUE(outline) << outline.error().message;
    return outline ? std::abs(area(outline->path)) : 0;
}

std::string svg_with(const std::string& shape)
{
    return R"(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 200 100">)" + shape +
           "</svg>";
}

TEST(OutlineReader, ReadsMillimetresFromTheViewBox)
{
    EXPECT_NEAR(area_read("a.svg", svg_with(R"(<rect x="10" y="10" width="40" height="20"/>)")), 200, 1e-9);
}

TEST(OutlineReader, KeepsArcsOfPathsExactly)
{
    EXPECT_NEAR(area_read("a.svg", svg_with(R"(<path d="m20 20a10 10 0 1 1 0 .0001z"/>)")), 25 * pi, 1e-2);
    EXPECT_NEAR(area_read("a.svg", svg_with(R"(<circle cx="9" cy="9" r="8"/>)")), 16 * pi, 1e-9);
}

TEST(OutlineReader, FollowsTransforms)
{
    const std::string shape =
        R"svg(<g transform="scale(2) rotate(30 5 5)"><polygon points="0,0 10,0 10,5 0,5"/></g>)svg";
    EXPECT_NEAR(area_read("a.svg", svg_with(shape)), 50, 1e-9);
}

TEST(OutlineReader, FlattensCurvesAndSaysSo)
{
    const auto outline = read_outline("a.svg", svg_with(R"(<path d="M0 0C0 40 80 40 80 0Z"/>)"));
    ASSERT_TRUE(outline);
    EXPECT_GT(outline->strayed, 0);
    EXPECT_NEAR(std::abs(area(outline->path)), 0.6 * 80 * 40 / 4, 0.1);
}

TEST(OutlineReader, JoinsLooseDxfSegments)
{
    const std::string dxf = "0\nSECTION\n2\nENTITIES\n"
                            "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n30\n21\n0\n"
                            "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n0\n21\n20\n"
                            "0\nARC\n8\n0\n10\n30\n20\n10\n40\n10\n50\n270\n51\n90\n"
                            "0\nLINE\n8\n0\n10\n30\n20\n20\n11\n0\n21\n20\n"
                            "0\nENDSEC\n0\nEOF\n";
    EXPECT_NEAR(area_read("a.dxf", dxf), 600 + 50 * pi, 1e-9);
}

TEST(OutlineReader, ReadsBulgesOfPolylines)
{
    const std::string dxf = "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n2\n70\n1\n"
                            "10\n0\n20\n0\n42\n1\n10\n10\n20\n0\n42\n1\n0\nENDSEC\n0\nEOF\n";
    EXPECT_NEAR(area_read("a.dxf", dxf), 25 * pi, 1e-9);
}

TEST(OutlineReader, NamesTheGapOfAnOpenOutline)
{
    const auto outline = read_outline("a.svg", svg_with(R"(<path d="M0 0H20V20"/>)"));
    ASSERT_FALSE(outline);
    EXPECT_NE(outline.error().message.find("not closed"), std::string::npos);
    EXPECT_NE(outline.error().message.find("14.142 mm"), std::string::npos) << outline.error().message;
}

TEST(OutlineReader, RefusesWhatIsNoOutline)
{
    for (const std::string text : {"", "{", "{}", R"({"outline": 3})", R"({"outline": [[1]]})", R"({"outline": []})"}) {
        EXPECT_FALSE(read_outline("a.json", text)) << text;
    }
    EXPECT_FALSE(read_outline("a.svg", svg_with(R"(<rect width="9" height="9"/><rect x="20" width="9" height="9"/>)")));
    EXPECT_FALSE(read_outline("a.svg", svg_with(R"(<path d="M0 0L1"/>)")));
    EXPECT_FALSE(read_outline("a.dxf", "0\nSECTION\n2\nENTITIES\n0\nSPLINE\n8\n0\n0\nENDSEC\n"));
    EXPECT_FALSE(read_outline("outline", "0"));
}

} // namespace
} // namespace rhombloom
