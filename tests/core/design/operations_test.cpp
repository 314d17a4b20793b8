// Every library shape x every operation x random parameters: a valid surface or a refusal with a reason.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "core/design/design_file.h"
#include "core/design/edit.h"
#include "core/design/extrude.h"
#include "core/design/history.h"
#include "core/design/merge.h"
#include "core/design/overlap.h"
#include "core/model/angular_defect.h"
#include "core/model/validity.h"
#include "tests/core/design/shapes.h"

namespace rhombloom {
namespace {

const Element element;

EmbedOptions coarse()
{
    EmbedOptions options;
    options.max_iterations = 15; // validity does not depend on the shape
    return options;
}

//! Two-colourable, one fan, permissible defects, in one part, and Gauss-Bonnet with the turning of the boundary.
void expect_valid(const Surface& surface)
{
    const Validity validity = validate(surface, element);
    RC_ASSERT(validity.problems == std::vector<std::string>{});
    RC_ASSERT(make_surface(lists(surface)).has_value());
    double curvature = 0;
    for (const Vertex v : surface.vertices()) {
        double angle = 0;
        for (const Face f : surface.vf_range(v)) {
            angle += corner_angle(surface, element, f, v);
        }
        curvature += (surface.is_boundary(v) ? pi : two_pi) - angle;
    }
    RC_ASSERT(std::abs(curvature - two_pi * validity.euler_characteristic) < 1e-9);
}

std::string any_shape(int elements)
{
    static const auto small = shapes::small_shapes(60);
    return *rc::gen::suchThat(rc::gen::elementOf(small), [&](const std::string& name) {
        return static_cast<int>(base_shape(name, element)->surface.n_faces()) <= elements;
    });
}

Vec3 any_direction()
{
    const auto number = rc::gen::map(rc::gen::inRange(-1000, 1001), [](int x) { return x / 1000.0; });
    Vec3 d(*number, *number, *number);
    return d.norm() > 1e-3 ? d.normalized() : Vec3::UnitZ();
}

RC_GTEST_PROP(Operations, ExtrudeGivesAValidSurfaceOrAReason, ())
{
    const BaseShape target = *base_shape(any_shape(60), element);
    const BaseShape brush = *base_shape(any_shape(40), element);
    ExtrudeRequest request;
    request.apex = Vertex(*rc::gen::inRange(0, static_cast<int>(target.surface.n_vertices())));
    request.drag = any_direction() * element.la * *rc::gen::inRange(1, 5);
    const auto made = extrude(target.surface, element, brush, request, coarse());
    if (!made) {
        RC_ASSERT(!made.error().message.empty());
        return;
    }
    expect_valid(made->surface);
}

RC_GTEST_PROP(Operations, MergeGivesAValidSurfaceOrAReason, ())
{
    const BaseShape a = *base_shape(any_shape(40), element);
    BaseShape b = *base_shape(any_shape(40), element);
    const Eigen::AngleAxisd turn(*rc::gen::inRange(0, 628) / 100.0, any_direction());
    const Vec3 offset = any_direction() * element.la * *rc::gen::inRange(0, 40) / 10.0;
    for (const Vertex v : b.surface.vertices()) {
        b.surface.set_point(v, turn * b.surface.point(v) + offset);
    }
    MergeOptions options;
    options.count = 2;
    options.embedding = coarse();
    const auto made = merge(a.surface, b.surface, element, 0, options);
    if (!made) {
        RC_ASSERT(!made.error().message.empty());
        return;
    }
    expect_valid(made->surface);
}

RC_GTEST_PROP(Operations, OpenAndFlipGiveAValidSurfaceOrAReason, ())
{
    Surface surface = base_shape(any_shape(60), element)->surface;
    for (int k = 0; k < 5; ++k) {
        const Face f(*rc::gen::inRange(0, static_cast<int>(surface.n_faces())));
        if (*rc::gen::arbitrary<bool>()) {
            if (auto opened = open_elements(surface, {f})) {
                surface = std::move(opened->surface);
            }
        } else if (auto flipped = flip_elements(surface, element, {f})) {
            surface = std::move(*flipped);
        }
        expect_valid(surface);
    }
}

TEST(Operations, FlippingTwiceIsTheIdentity)
{
    const Surface ball = base_shape("polar-5x4", element)->surface;
    const auto once = flip_elements(ball, element, {Face(7)});
    ASSERT_TRUE(once.has_value()) << once.error().message;
    const auto twice = flip_elements(*once, element, {Face(7)});
    ASSERT_TRUE(twice.has_value());
    EXPECT_EQ(lists(*twice).facing, lists(ball).facing);
    EXPECT_NE(lists(*once).facing, lists(ball).facing);
}

TEST(Operations, A30BallIsExtendedByItselfWithFlatVertices)
{
    const BaseShape ball = shapes::embedded("ball-30");
    Vertex apex;
    for (const Vertex v : ball.surface.vertices()) {
        if (ball.surface.valence(v) == 5) {
            apex = v;
        }
    }
    ExtrudeRequest request;
    request.apex = apex;
    request.drag = shapes::outward(ball.surface, apex) * 2 * element.la;
    const auto made = extrude(ball.surface, element, ball, request);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_EQ(made->first.size_difference, 0);
    EXPECT_NEAR(made->first.min_defect, 0, 1e-9); // two acute and two obtuse corners at every merged vertex
    EXPECT_GT(made->surface.n_faces(), 30u);
}

TEST(Operations, ALongDragMakesALongLimbThatFollowsIt)
{
    const BaseShape ball = shapes::embedded("ball-30");
    ExtrudeRequest request;
    request.apex = Vertex(0);
    const Vec3 direction = shapes::outward(ball.surface, Vertex(0));
    request.drag = direction * 12 * element.la;
    const auto made = extrude(ball.surface, element, ball, request);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_GE(made->periods, 3);
    EXPECT_TRUE(made->embedding.converged);
    EXPECT_NEAR(made->reached.norm(), request.drag.norm(), 1.5 * element.la);
    EXPECT_GT(made->reached.normalized().dot(direction), std::cos(radians(30)));
}

//! \p surface turned and moved at random so that it meets a 30-ball in the origin.
Surface any_pose(Surface surface)
{
    const Eigen::AngleAxisd turn(*rc::gen::inRange(0, 628) / 100.0, any_direction());
    const Vec3 offset = any_direction() * element.la * *rc::gen::inRange(10, 28) / 10.0;
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, turn * surface.point(v) + offset);
    }
    return surface;
}

// A single seam is checked without building the surface: every candidate must be buildable all the same.
RC_GTEST_PROP(Operations, EveryMergeCandidateIsAValidSurface, ())
{
    const Surface ball = base_shape("ball-30", element)->surface;
    const auto candidates = merge_candidates(ball, any_pose(base_shape(any_shape(40), element)->surface), element);
    for (std::size_t i = 0; candidates && i < candidates->size(); ++i) {
        int serial = 1000;
        const auto made = apply_grafts(ball, {(*candidates)[i].change}, serial);
        RC_ASSERT(made.has_value());
        expect_valid(made->surface);
    }
}

TEST(Operations, MergeNamesWhyItCannot)
{
    const BaseShape ball = shapes::embedded("ball-30");
    const BaseShape small = shapes::embedded("ball-6");
    Surface far = ball.surface;
    for (const Vertex v : far.vertices()) {
        far.set_point(v, far.point(v) + Vec3(1000, 0, 0));
    }
    EXPECT_NE(merge(ball.surface, far, element, 0).error().message.find("do not touch"), std::string::npos);
    EXPECT_NE(merge(ball.surface, small.surface, element, 0).error().message.find("inside"), std::string::npos);
}

TEST(Operations, MergedBallsStayCloseToTheirUnion)
{
    const BaseShape ball = shapes::embedded("ball-30");
    Surface moved = ball.surface;
    for (const Vertex v : moved.vertices()) {
        moved.set_point(v, moved.point(v) + Vec3(150, 20, 10));
    }
    const auto made = merge(ball.surface, moved, element, 0);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_TRUE(made->embedding.converged);
    double sum = 0;
    for (const Vertex v : made->surface.vertices()) {
        const Vec3 p = made->surface.point(v);
        sum += std::pow(std::min(signed_distance(ball.surface, p), signed_distance(moved, p)), 2);
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(made->surface.n_vertices())), 0.5 * element.la);
}

} // namespace
} // namespace rhombloom
