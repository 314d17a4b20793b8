#include "apps/studio/session/session.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "apps/studio/session/edits.h"
#include "core/design/design_file.h"

namespace rhombloom::studio {
namespace {

using Status = Outcome::Status;

//! A folder of its own for every test.
class SessionTest : public ::testing::Test
{
protected:
    void SetUp() override
    {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::path(::testing::TempDir()) / (std::string("studio-") + info->name());
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string file() const { return (folder_ / "design.json").string(); }

    std::string bytes() const
    {
        std::ifstream in(file());
        std::stringstream text;
        text << in.rdbuf();
        return text.str();
    }

    std::unique_ptr<Session> open() const
    {
        auto session = Session::open(file());
        EXPECT_TRUE(session) << (session ? "" : session.error().message);
        return session ? std::move(*session) : nullptr;
    }

    std::filesystem::path folder_;
};

Place ball(const std::string& id, const Vec3& at = Vec3::Zero())
{
    return Place{id, "ball-30", at, Vec3::Zero()};
}

TEST_F(SessionTest, StartsEmptyAndWritesNothingBeforeTheFirstChange)
{
    const auto session = open();
    EXPECT_EQ(session->snapshot()->revision, 1);
    EXPECT_TRUE(session->snapshot()->scene->parts.empty());
    EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(SessionTest, EveryChangeIsInTheFileWhenItIsReported)
{
    const auto session = open();
    const Outcome done = session->apply(1, ball("body"));
    ASSERT_EQ(done.status, Status::Done) << done.message;
    EXPECT_EQ(done.snapshot->revision, 2);
    EXPECT_EQ(bytes(), write_design(done.snapshot->design));
    EXPECT_EQ(open()->snapshot()->design.operations.size(), 1u);
}

TEST_F(SessionTest, AChangeOnAnOldRevisionChangesNothing)
{
    const auto session = open();
    ASSERT_EQ(session->apply(1, ball("body")).status, Status::Done);
    const std::string before = bytes();
    EXPECT_EQ(session->apply(1, ball("other", Vec3(900, 0, 0))).status, Status::Stale);
    EXPECT_EQ(session->undo(1).status, Status::Stale);
    EXPECT_EQ(bytes(), before);
    EXPECT_EQ(session->snapshot()->revision, 2);
}

TEST_F(SessionTest, UndoThenRedoGivesTheSameBytes)
{
    const auto session = open();
    session->apply(1, ball("body"));
    session->apply(2, Extrude{"", "body", {Reference::Kind::Toward, 0, Vec3::UnitZ()}, "rhombic-12", Vec3(0, 0, 150)});
    const std::string before = bytes();
    const Surface surface = session->snapshot()->scene->parts.front().surface;
    ASSERT_EQ(session->undo(3).status, Status::Done);
    EXPECT_EQ(session->snapshot()->scene->parts.front().surface.n_faces(), 30u);
    ASSERT_EQ(session->redo(4).status, Status::Done);
    EXPECT_EQ(bytes(), before);
    const Surface& again = session->snapshot()->scene->parts.front().surface;
    ASSERT_EQ(again.n_vertices(), surface.n_vertices());
    for (const Vertex v : again.vertices()) {
        EXPECT_EQ(again.point(v), surface.point(v));
    }
}

TEST_F(SessionTest, UndoReachesTheEmptyDocumentAndItCanBeOpenedAgain)
{
    const auto session = open();
    session->apply(1, ball("body"));
    ASSERT_EQ(session->undo(2).status, Status::Done);
    EXPECT_FALSE(session->snapshot()->can_undo);
    EXPECT_EQ(session->undo(3).status, Status::Refused);
    EXPECT_TRUE(open()->snapshot()->design.operations.empty());
}

TEST_F(SessionTest, AnOpenedDesignCanBeUndoneStepByStep)
{
    open()->apply(1, ball("body"));
    const auto session = open();
    EXPECT_TRUE(session->snapshot()->can_undo);
    EXPECT_EQ(session->undo(1).status, Status::Done);
    EXPECT_TRUE(session->snapshot()->design.operations.empty());
}

TEST_F(SessionTest, EditingAnEarlierStepReplaysTheRest)
{
    const auto session = open();
    session->apply(1, ball("body"));
    session->apply(2, Extrude{"", "body", {Reference::Kind::Toward, 0, Vec3::UnitZ()}, "rhombic-12", Vec3(0, 0, 150)});
    const auto before = session->snapshot()->scene->parts.front().surface.n_faces();
    const Outcome done = session->edit(3, 0, Place{"body", "ball-120", Vec3::Zero(), Vec3::Zero()});
    ASSERT_EQ(done.status, Status::Done) << done.message;
    EXPECT_GT(done.snapshot->scene->parts.front().surface.n_faces(), before + 60);
    ASSERT_EQ(session->undo(4).status, Status::Done);
    EXPECT_EQ(session->snapshot()->scene->parts.front().surface.n_faces(), before);
}

TEST_F(SessionTest, AnEditThatALaterStepCannotFollowIsRefusedByName)
{
    const auto session = open();
    session->apply(1, ball("body"));
    session->apply(2, Flip{"body", {Reference::Kind::Number, 0, Vec3::Zero()}});
    const std::string before = bytes();
    const Outcome refused = session->edit(3, 0, ball("other"));
    EXPECT_EQ(refused.status, Status::Refused);
    EXPECT_EQ(refused.operation, 1);
    EXPECT_NE(refused.message.find("step 2"), std::string::npos) << refused.message;
    EXPECT_EQ(bytes(), before);
}

TEST_F(SessionTest, AFileThatCannotBeWrittenChangesNothing)
{
    const auto session = open();
    session->apply(1, ball("body"));
    std::filesystem::remove_all(folder_);
    const Outcome failed = session->apply(2, ball("other", Vec3(900, 0, 0)));
    EXPECT_EQ(failed.status, Status::Failed);
    EXPECT_EQ(session->snapshot()->revision, 2);
    EXPECT_EQ(session->snapshot()->scene->parts.size(), 1u);
}

TEST_F(SessionTest, WhatAnotherProgramWroteIsTakenAndUndoBringsBackTheVersionBefore)
{
    const auto session = open();
    ASSERT_EQ(session->apply(1, ball("body")).status, Status::Done);
    const std::string ours = bytes();
    const std::string theirs = R"({"rhombloom": 1, "operations": [{"op": "place", "shape": "ball-12"}]})";
    std::ofstream(file()) << theirs;
    EXPECT_EQ(session->apply(2, ball("more", {500, 0, 0})).status, Status::Stale);
    EXPECT_EQ(bytes(), theirs);
    const SnapshotPointer now = session->snapshot();
    EXPECT_EQ(now->scene->parts[0].surface.n_faces(), 12U);
    EXPECT_EQ(session->undo(now->revision).status, Status::Done);
    EXPECT_EQ(bytes(), ours);
}

TEST_F(SessionTest, WhatIsWrittenWhileTheFileIsOpenedIsNotOverwritten)
{
    const std::string theirs = R"({"rhombloom": 1, "operations": [{"op": "place", "shape": "ball-12"}]})";
    std::ofstream(folder_ / "theirs.json") << theirs;
    ASSERT_EQ(::mkfifo(file().c_str(), 0600), 0);
    std::jthread writer([&] {
        std::ofstream pipe(file());
        pipe << R"({"rhombloom": 1, "operations": [{"op": "place", "shape": "ball-30"}]})" << std::flush;
        std::filesystem::rename(folder_ / "theirs.json", file());
    });
    const auto session = open(); // reads to the pipe's end, which comes after the new file
    EXPECT_EQ(session->snapshot()->scene->parts[0].surface.n_faces(), 30U);
    EXPECT_EQ(session->apply(1, ball("more", {500, 0, 0})).status, Status::Stale);
    EXPECT_EQ(bytes(), theirs);
}

TEST_F(SessionTest, AFileThatWasSpoiledElsewhereIsNeitherTakenNorOverwritten)
{
    const auto session = open();
    ASSERT_EQ(session->apply(1, ball("body")).status, Status::Done);
    std::ofstream(file()) << "{\"rhombloom\": 1, \"oper";
    const Outcome outcome = session->apply(2, ball("more", {500, 0, 0}));
    EXPECT_EQ(outcome.status, Status::Failed);
    EXPECT_NE(outcome.message.find("changed by another program"), std::string::npos) << outcome.message;
    EXPECT_EQ(bytes(), "{\"rhombloom\": 1, \"oper");
    std::filesystem::remove(file());
    EXPECT_EQ(session->apply(2, ball("more", {500, 0, 0})).status, Status::Done);
    EXPECT_NE(bytes().find("more"), std::string::npos);
}

TEST_F(SessionTest, AFileThatIsOnlyFormattedElsewhereIsNoChange)
{
    const auto session = open();
    ASSERT_EQ(session->apply(1, ball("body")).status, Status::Done);
    std::ofstream(file(), std::ios::app) << "\n\n";
    EXPECT_EQ(session->apply(2, ball("more", {500, 0, 0})).status, Status::Done);
}

TEST_F(SessionTest, AMalformedFileIsRefusedAndLeftAlone)
{
    std::ofstream(file()) << "{\"rhombloom\": 1, \"operations\": 5}";
    const auto session = Session::open(file());
    ASSERT_FALSE(session);
    EXPECT_NE(session.error().message.find("$.operations"), std::string::npos) << session.error().message;
    EXPECT_EQ(bytes(), "{\"rhombloom\": 1, \"operations\": 5}");
}

TEST(Edits, AMovedPartTakesItsLaterStepsAlong)
{
    Design design;
    design.operations = {
        ball("body", Vec3(10, 0, 0)),
        Extrude{"", "body", {Reference::Kind::Near, 0, Vec3(10, 0, 120)}, "rhombic-12", Vec3(0, 0, 150)}};
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.translate(Vec3(0, 5, 0));
    motion.rotate(Eigen::AngleAxisd(pi / 2, Vec3::UnitX()));
    const auto moved = moved_part(design, "body", motion);
    ASSERT_TRUE(moved) << moved.error().message;
    EXPECT_TRUE(std::get<Place>(moved->operations[0]).position.isApprox(Vec3(10, 5, 0)));
    EXPECT_TRUE(std::get<Place>(moved->operations[0]).rotation_deg.isApprox(Vec3(90, 0, 0)));
    EXPECT_TRUE(std::get<Extrude>(moved->operations[1]).by.isApprox(Vec3(0, -150, 0)));
    EXPECT_TRUE(std::get<Extrude>(moved->operations[1]).apex.point.isApprox(Vec3(10, -115, 0)));
}

TEST(Edits, AMergedPartCannotBeMovedByItself)
{
    Design design;
    design.operations = {ball("body"), ball("head", Vec3(0, 0, 150)), Merge{"body", "head", 0}};
    EXPECT_FALSE(moved_part(design, "head", Eigen::Isometry3d::Identity()));
    EXPECT_FALSE(moved_part(design, "body", Eigen::Isometry3d::Identity()));
    EXPECT_FALSE(moved_part(design, "tail", Eigen::Isometry3d::Identity()));
}

TEST(Edits, DeletingAPartDeletesWhatWasMergedIntoIt)
{
    Design design;
    design.operations = {ball("body"), ball("head"), Merge{"body", "head", 0}, ball("tail")};
    const auto left = without_part(design, "body");
    ASSERT_TRUE(left);
    ASSERT_EQ(left->operations.size(), 1u);
    EXPECT_EQ(subject(left->operations[0]), "tail");
}

TEST(Edits, AnglesComeBackFromTheirRotation)
{
    for (const Vec3& angles : {Vec3(10, 20, 30), Vec3(-170, 85, 120), Vec3(0, -90, 40), Vec3(0, 90, -25)}) {
        const Eigen::Matrix3d R = rotation_matrix(angles);
        EXPECT_TRUE(rotation_matrix(euler_deg(R)).isApprox(R, 1e-7)) << angles.transpose();
    }
}

} // namespace
} // namespace rhombloom::studio
