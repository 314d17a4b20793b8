#include "exporters/comparison.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "core/form/embedding.h"
#include "core/model/base_shapes.h"
#include "core/model/triangulation.h"
#include "exporters/preview.h"
#include "exporters/save.h"
#include "exporters/target_file.h"

namespace rhombloom {
namespace {

constexpr Element element;

Surface ball()
{
    Surface surface = base_shape("ball-30", element)->surface;
    embed(surface, element);
    return surface;
}

TriangleMesh target(double radius)
{
    const Triangulation unit = geodesic(Deltahedron::Icosahedron, 4, 0);
    TriangleMesh mesh{unit.points, unit.triangles};
    transform(mesh, radius, Vec3::Zero());
    return mesh;
}

//! A folder of its own that is gone afterwards.
struct Folder
{
    Folder()
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path = std::filesystem::temp_directory_path() / (std::string("rhombloom-") + test->name());
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
};

Design design_with(const TargetFile& file)
{
    Import import;
    import.id = "body";
    import.target = file.name;
    import.target_sha256 = file.sha256;
    Design design;
    design.operations = {import};
    return design;
}

TEST(Picture, GivenCameraAndTintAreUsed)
{
    const auto bent = bent_surface(ball(), element);
    PictureOptions options;
    options.width = options.height = 48;
    const auto usual = picture(*bent, options);
    options.tint = Eigen::Vector3f::Constant(0.4F);
    const auto grey = picture(*bent, options);
    const std::size_t middle = 4 * (48 * 24 + 24);
    EXPECT_GT(usual->rgba[middle] - usual->rgba[middle + 2], 10); // wood and orange: more red than blue
    EXPECT_LT(std::abs(grey->rgba[middle] - grey->rgba[middle + 2]), 12);
    options.background = Background::Transparent;
    options.camera = fitted_camera({Vec3(-2000, 0, 0), Vec3(2000, 0, 0)}, options);
    const auto far = picture(*bent, options);
    int covered = 0;
    for (std::size_t i = 3; i < far->rgba.size(); i += 4) {
        covered += far->rgba[i] > 0 ? 1 : 0;
    }
    EXPECT_GT(covered, 4);
    EXPECT_LT(covered, 48 * 48 / 20);
}

TEST(Comparison, IsAPngOfTwiceTheWidthTheSameEveryTime)
{
    PictureOptions options;
    options.width = options.height = 40;
    const auto png = comparison_png(ball(), element, target(120), options);
    ASSERT_TRUE(png);
    EXPECT_EQ(png->substr(1, 3), "PNG");
    EXPECT_EQ(static_cast<int>((*png)[19]), 80); // width and height in the header, big endian
    EXPECT_EQ(static_cast<int>((*png)[23]), 40);
    EXPECT_EQ(*png, *comparison_png(ball(), element, target(120), options));
    EXPECT_NE(*png, *comparison_png(ball(), element, target(60), options));
}

TEST(TargetFile, IsReadBackFromBesideTheDesign)
{
    const Folder folder;
    const TargetFile file = target_file(target(50));
    ASSERT_TRUE(save_file((folder.path / file.name).string(), file.bytes));
    const auto loaded = load_targets(design_with(file), folder.path.string());
    ASSERT_TRUE(loaded);
    ASSERT_TRUE(loaded->has_value());
    EXPECT_EQ((*loaded)->triangles, target(50).triangles);
    EXPECT_FALSE(load_targets(Design{}, folder.path.string())->has_value());
}

TEST(TargetFile, MissingChangedOrElsewhereIsRefusedWithTheFilesName)
{
    const Folder folder;
    TargetFile file = target_file(target(50));
    const auto missing = load_targets(design_with(file), folder.path.string());
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find(file.name + " is not beside the design"), std::string::npos);
    std::string changed = file.bytes;
    changed.back() = static_cast<char>(changed.back() ^ 1);
    ASSERT_TRUE(save_file((folder.path / file.name).string(), changed));
    const auto refused = load_targets(design_with(file), folder.path.string());
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("was changed since the import"), std::string::npos);
    EXPECT_NE(refused.error().message.find("operations[0].target"), std::string::npos);
    file.name = "../" + file.name;
    EXPECT_FALSE(load_targets(design_with(file), folder.path.string()));
}

TEST(Preview, ATargetIsAGhostInThe3dFilesAndAPictureOfItsOwn)
{
    Replay replay;
    replay.surface = ball();
    replay.embedding = measure(replay.surface, element);
    replay.stages.push_back({"place ball-30", replay.surface});
    const AssemblyPlan plan = assembly_plan(replay, element, Order::Paper);
    PreviewOptions options;
    options.thumbnail_size = 64;
    const auto without = preview_files(replay, plan, element, options);
    options.target = target(120);
    const auto with = preview_files(replay, plan, element, options);
    ASSERT_TRUE(with);
    EXPECT_FALSE(without->files.contains("target.png"));
    EXPECT_TRUE(with->files.contains("target.png"));
    EXPECT_EQ(without->files.at("preview-plain.glb").find("\"name\":\"target\""), std::string::npos);
    EXPECT_NE(with->files.at("preview-plain.glb").find("{\"name\":\"target\",\"nodes\":[30]}"), std::string::npos);
    EXPECT_NE(with->files.at("preview-plain.glb").find("{\"name\":\"target\",\"mesh\":30}"), std::string::npos);
    EXPECT_EQ(with->files.at("preview.glb"), without->files.at("preview.glb"));
    EXPECT_EQ(without->files.at("preview.html").find("id=\"ghost\""), std::string::npos);
    EXPECT_NE(with->files.at("preview.html").find("id=\"ghost\""), std::string::npos);
    EXPECT_LT(with->files.at("preview.html").size(), without->files.at("preview.html").size() + 30'000);
}

} // namespace
} // namespace rhombloom
