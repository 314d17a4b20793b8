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

const std::string shape = R"svg(<path d="M0 0H60V40H30V20H0Z"/>)svg"; // 1800 square units

std::string svg_page(const std::string& attributes, const std::string& inside)
{
    return R"(<svg xmlns="http://www.w3.org/2000/svg" )" + attributes + ">" + inside + "</svg>";
}

TEST(OutlineReader, FollowsThePageAsBrowsersDo)
{
    const std::string box = R"(viewBox="0 0 100 100" )";
    EXPECT_NEAR(area_read("a.svg", svg_page(R"(width="100mm" height="81mm" viewBox="0 0 100 80.7")", shape)), 1800,
                1e-9);
    EXPECT_NEAR(area_read("a.svg", svg_page(box + R"(width="20cm" height="10cm" preserveAspectRatio="none")", shape)),
                3600, 1e-9);
    EXPECT_NEAR(area_read("a.svg", svg_page(box + R"(width="1e2mm" height="100%")", shape)), 1800, 1e-9);
    EXPECT_FALSE(read_outline("a.svg", svg_page(box + R"(width="-5mm")", shape)));
    EXPECT_FALSE(read_outline("a.svg", svg_page(box + R"(width="20em")", shape)));
}

TEST(OutlineReader, FollowsInnerDrawingsClonesAndStyles)
{
    const std::string page = R"(width="100mm" height="100mm" viewBox="0 0 100 100")";
    const auto area_in = [&](const std::string& inside) { return area_read("a.svg", svg_page(page, inside)); };
    EXPECT_NEAR(area_in(R"(<svg x="9" y="9" width="50" height="50" viewBox="0 0 100 100">)" + shape + "</svg>"), 450,
                1e-9);
    EXPECT_NEAR(area_in(R"svg(<g style="fill:none; transform: translate(5px, 5px) scale(0.5)">)svg" + shape + "</g>"),
                450, 1e-9);
    EXPECT_NEAR(
        area_in(R"(<defs><g id="a">)" + shape + R"svg(</g></defs><use href="#a" transform="scale(.5)" x="7"/>)svg"),
        450, 1e-9);
    EXPECT_NEAR(
        area_in("<style>.a{fill:none} .h, g .b{display:none}</style><g class='a h'><rect width='9' height='9'/></g>" +
                shape),
        1800, 1e-9);
    EXPECT_NEAR(area_in(R"(<rect width="0" height="5"/><path visibility="hidden" d="M0 0H9V9Z"/>)" + shape + shape),
                1800, 1e-9);
    EXPECT_NEAR(area_in(R"(<rect width="10px" height="10"/>)"), 100, 1e-9);
    EXPECT_NEAR(area_read("a.svg", svg_page("", R"(<rect width="1in" height="10mm"/>)")), 254, 1e-9);
    EXPECT_FALSE(read_outline("a.svg", svg_page(page, R"(<g id="a"><use href="#a"/></g>)")));
    EXPECT_FALSE(read_outline("a.svg", svg_page(page, R"(<use href="#nothing"/>)")));
    EXPECT_FALSE(read_outline("a.svg", svg_page(page, R"(<rect width="-5" height="5"/>)")));
}

std::string dxf_with(const std::string& entities, const std::string& before = "")
{
    return before + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

const std::string box_dxf =
    "0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n0\n20\n0\n10\n40\n20\n0\n10\n40\n20\n20\n10\n0\n20\n20\n";

// Three of four corners would be read as a triangle.
TEST(OutlineReader, RefusesADxfFileThatBreaksOff)
{
    const std::string whole = dxf_with(box_dxf);
    EXPECT_NEAR(area_read("a.dxf", whole), 800, 1e-9);
    for (const std::size_t end : {whole.find("0\nENDSEC"), whole.find("0\nEOF"), whole.find("10\n0\n20\n20\n")}) {
        const auto read = read_outline("a.dxf", whole.substr(0, end));
        ASSERT_FALSE(read.has_value()) << end;
        EXPECT_NE(read.error().message.find("breaks off"), std::string::npos) << read.error().message;
    }
}

TEST(OutlineReader, ReadsEllipsesSplinesAndBlocksOfDxf)
{
    const std::string ellipse = "0\nELLIPSE\n10\n50\n20\n50\n11\n30\n21\n0\n40\n0.4\n41\n0\n42\n6.283185307179586\n";
    EXPECT_NEAR(area_read("a.dxf", dxf_with(ellipse)), pi * 30 * 12, 0.4);
    const std::string spline = "0\nSPLINE\n71\n3\n40\n0\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n40\n1\n"
                               "10\n0\n20\n0\n10\n0\n20\n20\n10\n40\n20\n20\n10\n40\n20\n0\n"
                               "0\nLINE\n10\n40\n20\n0\n11\n0\n21\n0\n";
    EXPECT_NEAR(area_read("a.dxf", dxf_with(spline)), 480, 0.1);
    const std::string block =
        "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB\n10\n5\n20\n5\n" + box_dxf + "0\nENDBLK\n0\nENDSEC\n";
    const std::string insert = "0\nINSERT\n2\nB\n10\n9\n20\n9\n41\n2\n42\n2\n50\n30\n";
    EXPECT_NEAR(area_read("a.dxf", dxf_with(insert, block)), 3200, 1e-9);
    EXPECT_FALSE(read_outline("a.dxf", dxf_with(insert)));
    const std::string loop = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB\n" + insert + insert + "0\nENDBLK\n0\nENDSEC\n";
    EXPECT_FALSE(read_outline("a.dxf", dxf_with(insert, loop)));
}

TEST(OutlineReader, ReadsOfDxfWhatIsSeenInModelSpace)
{
    const std::string layers = "0\nSECTION\n2\nTABLES\n0\nLAYER\n2\nOFF\n70\n0\n62\n-7\n0\nENDSEC\n";
    const std::string hidden = "0\nCIRCLE\n8\nOFF\n10\n0\n20\n0\n40\n9\n0\nCIRCLE\n8\n0\n67\n1\n10\n0\n20\n0\n40\n9\n";
    EXPECT_NEAR(area_read("a.dxf", dxf_with(hidden + box_dxf, layers)), 800, 1e-9);
    EXPECT_NEAR(area_read("a.dxf", "\xEF\xBB\xBF" + dxf_with(box_dxf) + "\n\n\n"), 800, 1e-9);
    const std::string mils = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n9\n0\nENDSEC\n";
    EXPECT_NEAR(area_read("a.dxf", dxf_with(box_dxf, mils)), 800 * 0.0254 * 0.0254, 1e-9);
}

TEST(OutlineReader, ChainsMayBeginAnywhereAndGapsAreNamedTruly)
{
    const auto lines = [](const std::string& y) {
        return dxf_with("0\nLINE\n10\n0\n20\n0\n11\n30\n21\n0\n0\nLINE\n10\n30\n20\n" + y +
                        "\n11\n30\n21\n20\n0\nLINE\n10\n30\n20\n20\n11\n0\n21\n0\n"
                        "0\nLINE\n10\n0\n20\n0\n11\n30\n21\n0\n");
    };
    EXPECT_NEAR(area_read("a.dxf", lines("0.03")), 300, 1);
    const auto outline = read_outline("a.dxf", lines("0.4"));
    ASSERT_FALSE(outline);
    EXPECT_NE(outline.error().message.find("a gap of 0.4 mm"), std::string::npos) << outline.error().message;
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
