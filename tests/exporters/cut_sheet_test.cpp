#include "exporters/cut_sheet.h"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "exporters/cut_drawing.h"
#include "exporters/segment.h"

namespace rhombloom {
namespace {

std::size_t occurrences(const std::string& text, const std::string& word)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        ++count;
    }
    return count;
}

CutFiles cut(int count, const CutOptions& options = {})
{
    const Element element;
    auto files = cut_files(element, hook_parameters(element), count, options);
    EXPECT_TRUE(files) << (files ? "" : files.error().message);
    return *files;
}

std::size_t pieces(const CutFiles& files)
{
    std::size_t sum = 0;
    for (const auto& [path, bytes] : files.files) {
        if (path.find("sheet-") != std::string::npos && path.ends_with(".dxf")) {
            sum += occurrences(bytes, "\n  8\nCUT_OUTER\n100\nAcDbPolyline");
        }
    }
    return sum;
}

TEST(CutFiles, HoldEveryPieceAndTheSpares)
{
    CutOptions options;
    options.spares = 0.03;
    const CutFiles files = cut(40, options);
    EXPECT_EQ(files.report.spares, 2); // 1.2, rounded up
    EXPECT_EQ(pieces(files), 42U);
    EXPECT_EQ(occurrences(files.files.at("cut/sheet-01.svg"), "<path id=\"element-1\""), 1U);
}

TEST(CutFiles, AreTheSameBytesEveryTime)
{
    EXPECT_EQ(cut(12).files, cut(12).files);
}

TEST(CutFiles, LeaveOutEngravingAndAnnotationsWhenAsked)
{
    CutOptions options;
    options.engraving = Engraving::Off;
    options.annotations = false;
    const std::string text = cut(3, options).files.at("cut/sheet-01.svg");
    EXPECT_EQ(text.find("-mark"), std::string::npos);
    EXPECT_EQ(text.find("SHEET"), std::string::npos);
    EXPECT_NE(cut(3).files.at("cut/sheet-01.svg").find("-mark"), std::string::npos);
}

TEST(CutFiles, RefuseAbsurdOptions)
{
    const Element element;
    const auto refused = [&](auto change) {
        CutOptions options;
        change(options);
        return !cut_files(element, hook_parameters(element), 3, options);
    };
    EXPECT_TRUE(refused([](CutOptions& o) { o.sheet_width = 0; }));
    EXPECT_TRUE(refused([](CutOptions& o) { o.sheet_height = std::nan(""); }));
    EXPECT_TRUE(refused([](CutOptions& o) { o.margin = -1; }));
    EXPECT_TRUE(refused([](CutOptions& o) { o.kerf_x = 50; }));
    EXPECT_TRUE(refused([](CutOptions& o) { o.kerf_x = 0.2, o.spacing = 0.1; }));
    EXPECT_TRUE(refused([](CutOptions& o) { o.speeds.cut = 0; }));
    EXPECT_TRUE(refused([](CutOptions& o) { o.sheet_width = o.sheet_height = 60; }));
    EXPECT_FALSE(cut_files(element, hook_parameters(element), 0, {}));
}

TEST(CutFiles, ReportMassAndLengthOfThePieces)
{
    const CutReport report = cut(30).report;
    EXPECT_NEAR(report.mass_g / 30, 2.95, 0.02);
    EXPECT_NEAR(report.cut_length_m / 30, 0.449, 0.005);
    EXPECT_GT(report.minutes, 30 * 0.449 / 0.02 / 60);
    EXPECT_FALSE(report.cost);
}

//! The contours that the tool follows, of any valid element at any kerf.
RC_GTEST_PROP(CutDrawings, ContoursAreSimpleAndLargerByTheKerf, ())
{
    Element element;
    element.la = *rc::gen::inRange(40, 201);
    element.lb = element.la * *rc::gen::inRange(1050, 1151) / 1000.0;
    element.alpha = radians(*rc::gen::inRange(520, 781) / 10.0);
    element.thickness = *rc::gen::inRange(20, 81) / 100.0;
    const double kerf = *rc::gen::inRange(0, 41) / 100.0;
    const Path outline = *element_outline(hook_parameters(element));
    Blank blank(outline, {kerf, kerf});
    const auto piece = blank.laid({*rc::gen::inRange(0, 628) / 100.0, false, Vec2(100, 50)});
    RC_ASSERT(piece.has_value());
    RC_ASSERT(is_simple(piece->outer));
    RC_ASSERT(piece->outer.vertices.back().bulge == 0);
    for (const Segment& segment : segments(piece->outer)) {
        RC_ASSERT(length(segment) >= shortest_segment - 1e-9);
    }
    if (piece->inner.empty()) {
        const double expected = area(outline) + length(outline) * kerf / 2 + pi * kerf * kerf / 4;
        RC_ASSERT(std::abs(area(piece->outer) / expected - 1) < 2e-4);
    }
}

TEST(CutDrawings, SmallSheetsGoWithoutACouponAndSaySo)
{
    Element element;
    element.la = 40;
    element.lb = 44;
    CutOptions options;
    options.sheet_width = 75;
    options.sheet_height = 55;
    const auto drawings = cut_drawings(element, hook_parameters(element), 1, options);
    ASSERT_TRUE(drawings) << drawings.error().message;
    EXPECT_FALSE(drawings->coupon);
    EXPECT_EQ(drawings->report.warnings.size(), 1U);
}

TEST(CutDrawings, TheOffcutIsFilledFirst)
{
    CutOptions options;
    options.remnant = SheetSize{300, 200};
    const auto drawings = cut_drawings({}, hook_parameters({}), 30, options);
    ASSERT_TRUE(drawings) << drawings.error().message;
    EXPECT_EQ(drawings->sheets.front().width, 300);
    EXPECT_EQ(drawings->sheets.back().width, 600);
}

TEST(CutFiles, CostIsReportedWhenAPriceIsGiven)
{
    CutOptions options;
    options.price_per_sheet = 4;
    options.price_per_minute = 0.5;
    const CutReport report = cut(5, options).report;
    EXPECT_NEAR(report.cost.value(), 4 + 0.5 * report.minutes, 1e-9);
}

} // namespace
} // namespace rhombloom
