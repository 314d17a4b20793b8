#include "core/design/history.h"

#include <gtest/gtest.h>

#include "core/design/design_file.h"
#include "core/model/validity.h"

namespace rhombloom {
namespace {

constexpr const char* two_limbs = R"({"rhombloom": 1, "symmetry": {"mirror": [1, 0, 0]}, "operations": [
    {"op": "place", "id": "body", "shape": "polar-4x6"},
    {"op": "extrude", "on": "body", "apex": {"toward": [1, 0, 0]}, "brush": "rhombic-12", "by_mm": [150, 0, 0],
     "symmetric": true},
    {"op": "open", "on": "body", "elements": [{"toward": [0, 0, -1]}], "purpose": "lamp holder"}]})";

std::vector<double> coordinates(const Surface& surface)
{
    std::vector<double> result;
    for (const Vertex v : surface.vertices()) {
        for (int k = 0; k < 3; ++k) {
            result.push_back(surface.point(v)[k]);
        }
    }
    return result;
}

TEST(Replay, TwiceGivesTheSameBytes)
{
    const Design design = *parse_design(two_limbs);
    const auto first = replay(design);
    const auto second = replay(design);
    ASSERT_TRUE(first.has_value()) << first.error().message;
    EXPECT_EQ(coordinates(first->surface), coordinates(second->surface));
    EXPECT_EQ(lists(first->surface).quads, lists(second->surface).quads);
}

//! The farthest that a vertex's mirror image (in x) lies from any vertex, mm.
double asymmetry(const Surface& surface)
{
    double worst = 0;
    for (const Vertex v : surface.vertices()) {
        const Vec3 image = surface.point(v).cwiseProduct(Vec3(-1, 1, 1));
        double nearest = 1e300;
        for (const Vertex w : surface.vertices()) {
            nearest = std::min(nearest, (surface.point(w) - image).norm());
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

TEST(Replay, SymmetricLimbsAreMirrorImages)
{
    const auto result = replay(*parse_design(two_limbs));
    ASSERT_TRUE(result.has_value()) << result.error().message;
    const Surface& surface = result->stages[1].surface;
    EXPECT_TRUE(validate(surface, Element{}).ok());
    EXPECT_LT(asymmetry(surface), 1e-3 * 80);
}

TEST(Replay, ASymmetricMergeJoinsTheImageOfThePartToo)
{
    const auto result = replay(*parse_design(R"({"rhombloom": 1, "symmetry": {"mirror": [1, 0, 0]}, "operations": [
        {"op": "place", "id": "body", "shape": "checker-80", "rotation_deg": [0, 0, 90]},
        {"op": "place", "id": "leg", "shape": "polar-3x10", "position_mm": [100, 0, -340], "rotation_deg": [0, -8, 0]},
        {"op": "merge", "on": "body", "with": "leg", "symmetric": true}]})"));
    ASSERT_TRUE(result.has_value()) << result.error().message;
    EXPECT_TRUE(validate(result->surface, Element{}).ok());
    EXPECT_LT(asymmetry(result->surface), 1e-3 * 80);
    EXPECT_EQ(result->surface.components, (std::vector<std::string>{"body", "leg", "leg 2"}));
    std::set<int> serials;
    for (const Face f : result->surface.faces()) {
        EXPECT_TRUE(serials.insert(result->surface.data(f).serial).second);
    }
}

TEST(Replay, ElementsKeepTheirSerialForAsLongAsTheyExist)
{
    const auto result = replay(*parse_design(two_limbs));
    ASSERT_TRUE(result.has_value());
    std::set<int> before;
    for (const Face f : result->stages[1].surface.faces()) {
        EXPECT_TRUE(before.insert(result->stages[1].surface.data(f).serial).second);
    }
    for (const Face f : result->surface.faces()) {
        EXPECT_TRUE(before.contains(result->surface.data(f).serial));
    }
    EXPECT_EQ(result->surface.n_faces() + 1, before.size());
}

TEST(Replay, NamesTheOperationThatDoesNotFit)
{
    const auto missing = replay(*parse_design(R"({"rhombloom": 1, "operations": [
        {"op": "place", "shape": "ball-30"}, {"op": "merge", "with": "head"}]})"));
    EXPECT_NE(missing.error().message.find("$.operations[1]"), std::string::npos);
    EXPECT_NE(missing.error().message.find("head"), std::string::npos);
    const auto apart = replay(*parse_design(R"({"rhombloom": 1, "operations": [
        {"op": "place", "shape": "ball-30"}, {"op": "place", "id": "head", "shape": "ball-30"}]})"));
    EXPECT_NE(apart.error().message.find("body, head"), std::string::npos);
    const auto lopsided = replay(*parse_design(R"({"rhombloom": 1, "operations": [
        {"op": "place", "shape": "ball-30"},
        {"op": "flip", "element": {"element": 0}, "symmetric": true}]})"));
    EXPECT_NE(lopsided.error().message.find("symmetry"), std::string::npos);
}

TEST(History, UndoThenRedoGivesTheSameBytes)
{
    History history(*parse_design(two_limbs));
    const std::string before = write_design(history.design());
    history.undo();
    history.undo();
    EXPECT_EQ(history.design().operations.size(), 1u);
    EXPECT_NE(write_design(history.design()), before);
    history.redo();
    history.redo();
    EXPECT_FALSE(history.can_redo());
    EXPECT_EQ(write_design(history.design()), before);
}

TEST(History, AddingAfterUndoDropsWhatWasUndone)
{
    History history(*parse_design(two_limbs));
    history.undo();
    history.add(Flip{"body", {}, false});
    EXPECT_EQ(history.size(), 3);
    EXPECT_FALSE(history.can_redo());
}

TEST(History, EditingAnEarlierOperationReplaysTheRestOrNamesTheFirstThatDoesNotFit)
{
    History history(*parse_design(two_limbs));
    Place place = std::get<Place>(history.design().operations[0]);
    place.shape = "polar-4x4";
    EXPECT_TRUE(history.edit(0, place).has_value());
    const std::string before = write_design(history.design());
    place.id = "torso";
    const auto refused = history.edit(0, place);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().message.find("$.operations[1]"), std::string::npos);
    EXPECT_EQ(write_design(history.design()), before);
}

} // namespace
} // namespace rhombloom
