// Operations on what designs seldom contain: open surfaces, genus 1, one element, many elements, odd elements, drags
// that lead nowhere, elements named twice, axes of many folds. A valid surface or a refusal with a reason, always.
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "core/design/design_file.h"
#include "core/design/edit.h"
#include "core/design/extrude.h"
#include "core/design/history.h"
#include "core/design/merge.h"
#include "core/model/validity.h"
#include "tests/core/design/shapes.h"

namespace rhombloom {
namespace {

EmbedOptions coarse()
{
    EmbedOptions options;
    options.max_iterations = 15; // validity does not depend on the shape
    return options;
}

const std::vector<std::string> odd_shapes = {"sheet-1x1", "sheet-2x1", "sheet-1x4", "sheet-5x3", "tube-3x1",
                                             "tube-4x4",  "dome-3x1",  "dome-8x2",  "torus-6x6", "torus-12x6",
                                             "ball-6",    "ball-12",   "polar-8x4", "ball-36",   "rhombic-6"};

Element any_element()
{
    const Element odd[] = {{40, 44, radians(63.435), 0.25},
                           {80, 88, radians(52), 0.5},
                           {80, 88, radians(76), 0.5},
                           {200, 300, radians(80), 0.8},
                           {40, 40.5, radians(50), 0.2}};
    return odd[*rc::gen::inRange(0, 5)];
}

Symmetry any_symmetry()
{
    Symmetry result;
    result.kind = *rc::gen::element(Symmetry::Kind::None, Symmetry::Kind::Mirror, Symmetry::Kind::Axis);
    result.direction = Vec3::Unit(*rc::gen::inRange(0, 3));
    result.fold = *rc::gen::inRange(2, 13);
    return result;
}

Vec3 any_vector(double longest)
{
    const auto number = rc::gen::map(rc::gen::inRange(-1000, 1001), [=](int x) { return longest * x / 1000; });
    return {*number, *number, *number};
}

template <class Made>
void expect_valid_or_reason(const Expected<Made>& made, const Element& element)
{
    if (made) {
        RC_ASSERT(validate(made->surface, element).problems == std::vector<std::string>{});
        RC_ASSERT(make_surface(lists(made->surface)).has_value());
    } else {
        RC_ASSERT(!made.error().message.empty());
    }
}

RC_GTEST_PROP(OddInputs, ExtrudeGivesAValidSurfaceOrAReason, ())
{
    const Element element = any_element();
    const auto target = base_shape(*rc::gen::elementOf(odd_shapes), element);
    const auto brush = base_shape(*rc::gen::elementOf(odd_shapes), element);
    RC_PRE(target.has_value() && brush.has_value()); // few elements leave no room at some angles
    ExtrudeRequest request;
    request.apex = Vertex(*rc::gen::inRange(0, static_cast<int>(target->surface.n_vertices())));
    request.drag = any_vector(4 * element.la);
    request.candidate = *rc::gen::element(0, 0, 1, 40);
    request.symmetry = any_symmetry();
    request.all_images = *rc::gen::arbitrary<bool>();
    expect_valid_or_reason(extrude(target->surface, element, *brush, request, coarse()), element);
}

RC_GTEST_PROP(OddInputs, MergeGivesAValidSurfaceOrAReason, ())
{
    const Element element = any_element();
    const auto a = base_shape(*rc::gen::elementOf(odd_shapes), element);
    auto b = base_shape(*rc::gen::elementOf(odd_shapes), element);
    RC_PRE(a.has_value() && b.has_value());
    const Vec3 offset = any_vector(2 * element.la);
    const double turn = *rc::gen::inRange(0, 4) * 0.5; // 0: coplanar elements, the same vertices
    for (const Vertex v : b->surface.vertices()) {
        b->surface.set_point(v, Eigen::AngleAxisd(turn, Vec3::UnitZ()) * b->surface.point(v) + offset);
    }
    MergeOptions options;
    options.symmetry = any_symmetry();
    options.all_images = *rc::gen::arbitrary<bool>();
    options.embedding = coarse();
    expect_valid_or_reason(merge(a->surface, b->surface, element, *rc::gen::element(0, 0, 1, 20), options), element);
}

TEST(OddInputs, DragsThatLeadNowhereAreRefusedWithTheReason)
{
    const Element element;
    const BaseShape ball = *base_shape("ball-30", element);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double endless = std::numeric_limits<double>::infinity();
    const auto refusal = [&](const Vec3& drag) {
        ExtrudeRequest request;
        request.apex = Vertex(0);
        request.drag = drag;
        const auto made = extrude(ball.surface, element, ball, request, coarse());
        return made ? "" : made.error().message;
    };
    EXPECT_NE(refusal(Vec3::Zero()).find("shorter"), std::string::npos);
    EXPECT_NE(refusal(Vec3(1e-300, 0, 0)).find("shorter"), std::string::npos);
    for (const double bad : {nan, endless, -endless, 1e300}) {
        EXPECT_NE(refusal(Vec3(0, bad, 1)).find("not a length"), std::string::npos) << bad;
    }
}

TEST(OddInputs, AnApexOnAnOpeningOrOutOfRangeIsRefusedWithTheReason)
{
    const Element element;
    const BaseShape sheet = *base_shape("sheet-4x4", element);
    const BaseShape ball = *base_shape("ball-30", element);
    for (const auto& [vertex, reason] : {std::pair(0, "opening"), {-1, "25 vertices"}, {25, "25 vertices"}}) {
        ExtrudeRequest request;
        request.apex = Vertex(vertex);
        request.drag = 100 * Vec3::UnitZ();
        const auto made = extrude(sheet.surface, element, ball, request, coarse());
        ASSERT_FALSE(made.has_value()) << vertex;
        EXPECT_NE(made.error().message.find(reason), std::string::npos) << made.error().message;
    }
}

TEST(OddInputs, AnElementNamedTwiceIsOpenedOrFlippedOnce)
{
    const Element element;
    const Surface ball = base_shape("polar-5x4", element)->surface;
    const auto twice = with_images(ball, element, {}, {Face(3), Face(3)});
    ASSERT_TRUE(twice.has_value());
    EXPECT_EQ(*twice, std::vector<Face>{Face(3)});
    const auto replayed = replay(*parse_design(R"({"rhombloom": 1, "operations": [
        {"op": "place", "shape": "ball-30"}, {"op": "open", "elements": [{"element": 3}, {"element": 3}]}]})"));
    ASSERT_TRUE(replayed.has_value()) << replayed.error().message;
    EXPECT_EQ(replayed->surface.n_faces(), 29u);
}

TEST(OddInputs, ALimbOnASurfaceOf2000ElementsLeavesTheFarSideWhereItWas)
{
    const Element element;
    const BaseShape target = shapes::embedded("checker-1920");
    const BaseShape brush = shapes::embedded("polar-5x4");
    ExtrudeRequest request;
    request.apex = Vertex(0);
    request.drag = shapes::outward(target.surface, Vertex(0)) * 2 * element.la;
    const auto made = extrude(target.surface, element, brush, request);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_TRUE(made->embedding.converged);
    EXPECT_TRUE(validate(made->surface, element).ok());
    double lowest_before = 0;
    double lowest = 0;
    for (const Vertex v : target.surface.vertices()) {
        lowest_before = std::min(lowest_before, request.drag.normalized().dot(target.surface.point(v)));
    }
    for (const Vertex v : made->surface.vertices()) {
        lowest = std::min(lowest, request.drag.normalized().dot(made->surface.point(v)));
    }
    EXPECT_NEAR(lowest, lowest_before, 0.1 * element.la);
}

TEST(OddInputs, EverythingCanBeUndoneAndDoneAgain)
{
    const Design design = *parse_design(R"({"rhombloom": 1, "symmetry": {"axis": [0, 0, 1], "fold": 5}, "operations": [
        {"op": "place", "shape": "checker-80"},
        {"op": "extrude", "apex": {"near_mm": [151, 110, 37]}, "brush": "polar-4x6", "by_mm": [300, 218, 60],
         "symmetric": true},
        {"op": "open", "elements": [{"toward": [0, 0.1, -1]}], "symmetric": true}]})");
    History history(design);
    const std::string before = write_design(history.design());
    while (history.can_undo()) {
        history.undo();
    }
    EXPECT_EQ(history.cursor(), 0);
    EXPECT_TRUE(history.design().operations.empty());
    EXPECT_FALSE(replay(history.design()).has_value());
    while (history.can_redo()) {
        history.redo();
    }
    EXPECT_EQ(write_design(history.design()), before);
    EXPECT_TRUE(replay(history.design()).has_value());
}

} // namespace
} // namespace rhombloom
