#include "exporters/preview.h"

#include <gtest/gtest.h>

#include "core/model/base_shapes.h"

namespace rhombloom {
namespace {

struct Sample
{
    Element element;
    Replay replay;
    AssemblyPlan plan;
};

Sample sample(const std::string& shape)
{
    Sample s;
    s.replay.surface = base_shape(shape, s.element)->surface;
    s.replay.embedding = embed(s.replay.surface, s.element);
    s.replay.stages.push_back({"place " + shape, s.replay.surface});
    s.plan = assembly_plan(s.replay, s.element, Order::Paper);
    return s;
}

PreviewFiles previews(const Sample& s, const PreviewOptions& options = {})
{
    return *preview_files(s.replay, s.plan, s.element, options);
}

TEST(Preview, MakesTheFourFiles)
{
    const PreviewFiles p = previews(sample("polar-5x4"));
    for (const char* name : {"preview.glb", "preview-plain.glb", "preview.html", "thumbnail.png"}) {
        ASSERT_TRUE(p.files.contains(name)) << name;
        EXPECT_GT(p.files.at(name).size(), 2000U) << name;
    }
    EXPECT_EQ(p.files.at("thumbnail.png").substr(1, 3), "PNG");
}

TEST(Preview, SameBytesEveryTime)
{
    const Sample s = sample("polar-5x4");
    EXPECT_EQ(previews(s).files, previews(s).files);
}

TEST(Preview, KeepsTheToleranceAsked)
{
    const Sample s = sample("ball-120");
    for (const double tolerance : {0.5, 0.05, 0.01}) {
        PreviewOptions options;
        options.tolerance_mm = tolerance;
        options.thumbnail_size = 64;
        const PreviewReport report = previews(s, options).report;
        EXPECT_LE(report.max_position_error_mm, tolerance);
        EXPECT_GT(report.max_position_error_mm, 0.05 * tolerance); // it is measured, and bits are not wasted
    }
}

TEST(Preview, ManyElementsStaySmall)
{
    PreviewOptions options;
    options.thumbnail_size = 64;
    const PreviewReport report = previews(sample("ball-210"), options).report;
    EXPECT_EQ(report.encoding, PreviewEncoding::BendingModes);
    EXPECT_LT(report.glb_bytes, 75'000U);
    EXPECT_LT(report.html_bytes, 80'000U);
}

TEST(Preview, PageLoadsNothing)
{
    const std::string html = previews(sample("polar-3x3")).files.at("preview.html");
    EXPECT_NE(html.find("default-src 'none'; script-src 'sha256-"), std::string::npos);
    for (const char* word : {"http://", "https://", "src=\"", "import(", "fetch("}) {
        EXPECT_EQ(html.find(word), std::string::npos) << word;
    }
}

TEST(Preview, TitleCannotBreakThePage)
{
    PreviewOptions options;
    options.title = "</title><script>alert(1)</script>@DATA@\"\xff";
    const PreviewFiles p = previews(sample("polar-3x3"), options);
    EXPECT_EQ(p.files.at("preview.html").find("<script>alert"), std::string::npos);
    EXPECT_NE(p.files.at("preview.html").find("&lt;script&gt;alert(1)"), std::string::npos);
}

TEST(Preview, RefusesImpossibleOptions)
{
    const Sample s = sample("polar-3x3");
    for (const double tolerance : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
        PreviewOptions options;
        options.tolerance_mm = tolerance;
        EXPECT_FALSE(preview_files(s.replay, s.plan, s.element, options)) << tolerance;
    }
    PreviewOptions options;
    options.thumbnail_size = 100'000;
    const auto refused = preview_files(s.replay, s.plan, s.element, options);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("100000"), std::string::npos);
}

TEST(Picture, TransparentBackgroundIsClearAtTheBorder)
{
    PictureOptions options;
    options.width = options.height = 64;
    const Element element;
    const Surface surface = base_shape("polar-3x3", element)->surface;
    const std::string opaque = *surface_picture_png(surface, element, options);
    options.background = Background::Transparent;
    EXPECT_NE(opaque, *surface_picture_png(surface, element, options));
}

TEST(Picture, CameraSeesEverything)
{
    const std::vector<Vec3> points = {{-100, 5, 40}, {300, -80, 0}, {20, 90, -260}};
    PictureOptions options;
    options.width = 300;
    const PictureCamera camera = fitted_camera(points, options);
    for (const Vec3& p : points) {
        const Vec3 r = p - camera.eye;
        const double depth = -r.dot(camera.back);
        EXPECT_GT(depth, 0);
        EXPECT_LE(std::abs(r.dot(camera.up)), camera.tangent * depth);
        EXPECT_LE(std::abs(r.dot(camera.right)), camera.tangent * depth * options.width / options.height);
    }
}

} // namespace
} // namespace rhombloom
