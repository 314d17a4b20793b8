#include "exporters/save.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

namespace rhombloom {
namespace {

namespace fs = std::filesystem;

class Save : public testing::Test
{
protected:
    void SetUp() override
    {
        folder_ = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::size_t entries() const
    {
        return static_cast<std::size_t>(
            std::distance(fs::recursive_directory_iterator(folder_), fs::recursive_directory_iterator{}));
    }

    fs::path folder_;
};

TEST_F(Save, AFolderOfFilesReadsBack)
{
    ASSERT_TRUE(save_folder(path("kit"), {{"a.txt", "A"}, {"cut/b.txt", std::string(100000, 'b')}}).has_value());
    EXPECT_EQ(*load_file(path("kit/a.txt"), 10), "A");
    EXPECT_EQ(load_file(path("kit/cut/b.txt"), 1 << 20)->size(), 100000U);
    EXPECT_EQ(entries(), 4U);
}

TEST_F(Save, NothingChangesWhenOneFileCannotBeWritten)
{
    ASSERT_TRUE(save_folder(path("kit"), {{"a.txt", "old"}}).has_value());
    fs::create_directories(path("kit/z.txt")); // a folder stands where the file should go
    const auto result = save_folder(path("kit"), {{"a.txt", "new"}, {"cut/b.txt", "B"}, {"z.txt", "Z"}});
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().kind, Error::Kind::Machine);
    EXPECT_EQ(*load_file(path("kit/a.txt"), 10), "old");
    EXPECT_FALSE(fs::exists(path("kit/cut")));
}

TEST_F(Save, AFileInTheWayOfAFolderIsNamed)
{
    std::ofstream(path("kit")) << "a file";
    const auto result = save_folder(path("kit"), {{"a.txt", "A"}});
    ASSERT_FALSE(result.has_value());
    EXPECT_NE(result.error().message.find("a file of that name"), std::string::npos);
}

TEST_F(Save, AFullDeviceIsTheMachinesFailure)
{
    const auto result = save_file("/dev/full", std::string(1 << 20, 'x'));
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().kind, Error::Kind::Machine);
}

TEST_F(Save, RunsThatWriteTheSameFolderAtOnceDoNotDisturbEachOther)
{
    std::vector<std::thread> runs;
    std::atomic<int> failed = 0;
    for (const char letter : {'a', 'b', 'c', 'd'}) {
        runs.emplace_back([&, letter] {
            const std::string bytes(5000, letter);
            for (int i = 0; i < 5; ++i) {
                failed += save_folder(path("kit"), {{"1", bytes}, {"cut/2", bytes}}) ? 0 : 1;
            }
        });
    }
    for (std::thread& run : runs) {
        run.join();
    }
    EXPECT_EQ(failed, 0);
    EXPECT_EQ(*load_file(path("kit/1"), 10000), *load_file(path("kit/cut/2"), 10000)); // of one and the same run
    EXPECT_EQ(entries(), 4U);                                                          // kit, 1, cut, 2
}

TEST_F(Save, ALinkStaysAndLongNamesAreWritten)
{
    std::ofstream(path("real")) << "old";
    fs::create_symlink("real", path("link"));
    ASSERT_TRUE(save_file(path("link"), "new"));
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(*load_file(path("real"), 10), "new");
    EXPECT_TRUE(save_file(path(std::string(255, 'x')), "long"));
}

TEST_F(Save, LoadingTellsMissingFoldersAndOversizedFilesApart)
{
    std::ofstream(path("big")) << std::string(3000000, 'x');
    EXPECT_NE(load_file(path("none"), 10).error().message.find("does not exist"), std::string::npos);
    EXPECT_NE(load_file(folder_.string(), 10).error().message.find("is a folder"), std::string::npos);
    EXPECT_NE(load_file(path("big"), 2000000).error().message.find("larger than 2 MB"), std::string::npos);
}

} // namespace
} // namespace rhombloom
