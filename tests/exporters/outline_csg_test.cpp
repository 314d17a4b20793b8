// A second derivation of the outline: unions and differences of simple shapes by Clipper, no contour followed.

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "clipper_tools.h"
#include "exporters/hook_checks.h"
#include "exporters/outline.h"
#include "exporters/parameter_table.h"
#include "exporters/segment.h"
#include "table_elements.h"

namespace rhombloom {

namespace {

using ClipperLib::Paths;
using Points = std::vector<Vec2>;

//! Maps side coordinates (along, outward) of one end of a side to the plane.
struct End
{
    Vec2 node, along, outward;

    Vec2 operator()(double u, double o) const { return node + u * along + o * outward; }
};

Points disc(const Vec2& centre, double radius)
{
    Points points;
    for (int i = 0; i < 4000; ++i) {
        const double a = two_pi * i / 4000;
        points.push_back(centre + radius * Vec2(std::cos(a), std::sin(a)));
    }
    return points;
}

ClipperLib::Path counter_clockwise(const Points& points)
{
    ClipperLib::Path path = tests::to_clipper(points);
    if (!ClipperLib::Orientation(path)) {
        ClipperLib::ReversePath(path);
    }
    return path;
}

//! Both ends of each of four sides; long sides are 0 and 2.
std::vector<End> ends(const HookParameters& p)
{
    const Vec2 x(1, 0);
    const Vec2 s(std::cos(p.alpha), std::sin(p.alpha));
    const Vec2 corners[] = {Vec2::Zero(), p.lb * x, p.lb * x + p.la * s, p.la * s};
    std::vector<End> result;
    for (int i = 0; i < 4; ++i) {
        const Vec2 a = corners[i];
        const Vec2 b = corners[(i + 1) % 4];
        const Vec2 t = (b - a).normalized();
        const Vec2 outward(t.y(), -t.x());
        result.push_back({a, t, outward});
        result.push_back({b, -t, outward});
    }
    return result;
}

Points seat_fillet(const HookParameters& p, const End& at)
{
    const double turn = std::atan2(p.barb, p.lip - p.lip_rounding);
    const double radius = std::max(0.3, 0.2 + 0.06 / turn);
    const double k = radius * std::tan(turn / 2);
    const double shoulder = pivot_radius(p) + p.seat_clearance;
    // The triangle of the corner, less the disc that lies outside the material.
    Points fillet = {at(shoulder, 0), at(shoulder - k * std::sin(turn), k * std::cos(turn))};
    for (int i = 0; i <= 50; ++i) {
        const double a = turn * (1 - i / 50.0);
        fillet.push_back(at(shoulder - radius + radius * std::cos(a), -k + radius * std::sin(a)));
    }
    return fillet;
}

struct Shapes
{
    Paths material;
    Paths holes;
};

//! The lip, from corner to corner, with rounded ends; and what is cut at the neck.
void add_long_side(Shapes& shapes, const HookParameters& p, const End& a, const End& b)
{
    const double shoulder = pivot_radius(p) + p.seat_clearance;
    const double top = shoulder - p.barb + p.lip_rounding;
    const double straight = p.lip - p.lip_rounding;
    shapes.material.push_back(
        counter_clockwise({a(shoulder, 0), a(shoulder - p.barb, straight), a(top, straight), a(top, p.lip),
                           b(top, p.lip), b(top, straight), b(shoulder - p.barb, straight), b(shoulder, 0)}));
    for (const End& at : {a, b}) {
        Points quarter = {at(top, straight)};
        for (int i = 0; i <= 1000; ++i) {
            const double angle = pi / 2 * (1 + i / 1000.0);
            quarter.push_back(at(top + p.lip_rounding * std::cos(angle), straight + p.lip_rounding * std::sin(angle)));
        }
        shapes.material.push_back(counter_clockwise(quarter));
        if (p.barb > 0) {
            shapes.material.push_back(counter_clockwise(seat_fillet(p, at)));
        }
        // The strip between nominal side and neck, up to the shoulder.
        shapes.holes.push_back(
            counter_clockwise({at(0, 0), at(shoulder, 0), at(shoulder, -p.neck_setback), at(0, -p.neck_setback)}));
    }
}

void add_hook(Shapes& shapes, const HookParameters& p, const End& at)
{
    const Vec2 d(std::cos(p.finger_turn), -std::sin(p.finger_turn));
    const Vec2 n(-d.y(), d.x());
    const Vec2 pivot(pivot_radius(p) + p.slit / 2, 0);
    const auto local = [&](double along, double across) {
        const Vec2 q = pivot + along * d + across * n;
        return at(q.x(), q.y());
    };
    const double e = p.finger_length;
    const double s = p.slit / 2;
    const double w = p.finger_width;
    // Root: the disc's quarter from the node line to the finger, then the finger and its tip.
    Points root = {at(pivot.x(), 0), at(p.hole_radius, 0)};
    for (int i = 1; i <= 2000; ++i) {
        const double a = pi - (pi / 2 + p.finger_turn) * i / 2000;
        root.push_back(at(pivot.x() + (w + s) * std::cos(a), (w + s) * std::sin(a)));
    }
    shapes.material.push_back(counter_clockwise(root));
    shapes.material.push_back(counter_clockwise({local(0, 0), local(e, 0), local(e, s + w), local(0, s + w)}));
    shapes.material.push_back(counter_clockwise(disc(local(e, s + w / 2), w / 2)));
    // The slit: a stadium, wide open towards the middle of the side; and all that lies beyond the rim.
    shapes.holes.push_back(counter_clockwise(disc(local(0, 0), s)));
    shapes.holes.push_back(counter_clockwise({local(0, -s), local(e + w, -s), local(e + w, s), local(0, s)}));
}

Paths holes_of_scoop(const HookParameters& p, const End& a, const End& b)
{
    const Vec2 d(std::cos(p.finger_turn), -std::sin(p.finger_turn));
    const Vec2 n(-d.y(), d.x());
    const Vec2 pivot(pivot_radius(p) + p.slit / 2, 0);
    const Vec2 bottom = pivot - p.slit / 2 * n;
    Points area = {a(bottom.x(), bottom.y())};
    for (int i = 0; i <= 3000; ++i) {
        const Vec2 q = scoop_point(p, i / 3000.0);
        area.push_back(a(q.x(), q.y()));
    }
    area.push_back(b(bottom.x(), bottom.y()));
    area.push_back(b(bottom.x(), p.lip + 50));
    area.push_back(a(bottom.x(), p.lip + 50));
    return {counter_clockwise(area)};
}

Paths csg_outline(const HookParameters& p)
{
    const std::vector<End> at = ends(p);
    Shapes body;
    body.material.push_back(counter_clockwise({at[0](0, 0), at[2](0, 0), at[4](0, 0), at[6](0, 0)}));
    Paths shape = body.material;
    Shapes parts;
    for (const std::size_t side : {2u, 6u}) {
        shape = tests::clipper_combine(ClipperLib::ctDifference, shape, holes_of_scoop(p, at[side], at[side + 1]));
    }
    for (const std::size_t side : {0u, 4u}) {
        Shapes lip;
        add_long_side(lip, p, at[side], at[side + 1]);
        shape = tests::clipper_combine(ClipperLib::ctDifference, shape, lip.holes);
        shape = tests::clipper_combine(ClipperLib::ctUnion, shape, lip.material);
    }
    for (const End& corner : {at[0], at[2], at[4], at[6]}) {
        parts.holes.push_back(counter_clockwise(disc(corner.node, p.hole_radius)));
    }
    shape = tests::clipper_combine(ClipperLib::ctDifference, shape, parts.holes);
    for (const std::size_t end : {2u, 3u, 6u, 7u}) {
        Shapes hook;
        add_hook(hook, p, at[end]);
        const Paths finger = tests::clipper_combine(ClipperLib::ctDifference, hook.material, hook.holes);
        shape = tests::clipper_combine(ClipperLib::ctDifference, shape, hook.holes);
        shape = tests::clipper_combine(ClipperLib::ctUnion, shape, finger);
    }
    return shape;
}

//! The scoop's arcs stay within 0.001 mm of the cubic; all else is the same to rounding.
void expect_same(const HookParameters& p)
{
    const double bound = 6e-4 * p.la;
    const auto outline = element_outline(p);
    ASSERT_TRUE(outline) << outline.error().message;
    const Paths csg = csg_outline(p);
    const double difference = tests::difference_area({tests::to_clipper(*outline, 1e-6)}, csg);
    EXPECT_LT(difference, bound) << "la " << p.la << " alpha " << degrees(p.alpha) << " t " << p.thickness;
    ClipperLib::Paths grown = tests::clipper_offset(csg, 0.01, 1e-4);
    const Paths outside = tests::clipper_combine(ClipperLib::ctDifference, {tests::to_clipper(*outline, 1e-4)}, grown);
    EXPECT_EQ(tests::clipper_area(outside), 0) << "farther than 0.01 mm";
}

double between(double from, double to)
{
    return from + (to - from) * *rc::gen::inRange(0, 10001) / 10000.0;
}

} // namespace

TEST(OutlineCsg, TableElementsAreTheUnionOfTheirParts)
{
    for (const Element& element : tests::table_elements()) {
        expect_same(hook_parameters(element));
    }
}

TEST(OutlineCsg, TurnedFingersAndNoBarbToo)
{
    expect_same(piece_parameters(Element{}, {{"finger_turn", 8}})->hook);
    expect_same(piece_parameters(Element{}, {{"barb", 0}})->hook);
    expect_same(piece_parameters(Element{}, {{"alpha", 52}, {"scoop_depth", 15}})->hook);
}

RC_GTEST_PROP(Outline, IsSimpleAndCounterClockwiseForRandomElements, ())
{
    const double la = between(40, 200);
    const Element element = tests::element_of(la, between(0.2, 0.8), between(1.02, 1.35), between(50, 80));
    std::vector<ParameterSetting> settings;
    for (const Parameter& row : parameter_table()) {
        if (row.section != "Hook" || *rc::gen::inRange(0, 3) > 0) {
            continue;
        }
        const auto piece = *piece_parameters(element, settings);
        const double value = row.get(piece) * between(0.8, 1.25) + (row.name == "finger_turn" ? between(0, 8) : 0) +
                             (row.name == "relief" ? between(0, 1) : 0);
        settings.emplace_back(row.name, std::clamp(value, row.min, row.max));
    }
    const HookParameters p = piece_parameters(element, settings)->hook;
    const auto outline = element_outline(p);
    if (!outline) {
        RC_ASSERT(outline.error().message.find("hook: ") == 0u);
        RC_DISCARD("refused");
    }
    const double own = area(*outline);
    RC_ASSERT(own > 0);
    RC_ASSERT(is_simple(*outline));
    const ClipperLib::Path polygon = tests::to_clipper(*outline, 1e-4);
    RC_ASSERT(std::abs(tests::clipper_area({polygon}) - own) < 2e-5 * own);
    ClipperLib::Paths simple;
    ClipperLib::SimplifyPolygon(polygon, simple, ClipperLib::pftNonZero);
    RC_ASSERT(simple.size() == 1u);
    RC_ASSERT(std::abs(tests::clipper_area(simple) - own) < 2e-5 * own);
    for (const Segment& s : segments(*outline)) {
        RC_ASSERT(length(s) >= 0.05);
        RC_ASSERT(std::abs(s.bulge) <= 1 + 1e-12);
    }
}

TEST(Outline, PointsFollowTheContourAtEverySegmentCount)
{
    const Path outline = *element_outline(hook_parameters(Element{}));
    for (const int segments : {8, 32, 128, 500}) {
        const Points points = outline_points(outline, segments);
        double worst = 0;
        for (const Vec2& p : points) {
            double nearest = 1e300;
            for (const Segment& s : rhombloom::segments(outline)) {
                nearest = std::min(nearest, distance(s, p));
            }
            worst = std::max(worst, nearest);
        }
        EXPECT_LT(worst, 1e-9) << segments;
    }
    // A hundred and twenty-eight keep the largest piece within the tolerance of the exporters.
    const Path largest = *element_outline(hook_parameters(tests::element_of(200, 0.8)));
    const auto points = tests::to_clipper(outline_points(largest, 128));
    EXPECT_LT(std::abs(tests::clipper_area({points}) / area(largest) - 1), 1e-4);
}

TEST(Outline, ReliefRoundsTheNecksCornerAndLeavesTheSeat)
{
    const HookParameters sharp = hook_parameters(Element{});
    const HookParameters relieved = piece_parameters(Element{}, {{"relief", 0.3}})->hook;
    const Path a = *element_outline(sharp);
    const Path b = *element_outline(relieved);
    EXPECT_EQ(b.vertices.size(), a.vertices.size() + 4);
    EXPECT_LT(area(b), area(a));
    EXPECT_TRUE(check(relieved));
    double sharpest = 0;
    for (const std::vector<Segment>& all : {segments(b)}) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Vec2 t = tangent(all[i], 1);
            const Vec2 u = tangent(all[(i + 1) % all.size()], 0);
            sharpest = std::min(sharpest, std::atan2(t.x() * u.y() - t.y() * u.x(), t.dot(u)));
        }
    }
    EXPECT_GT(sharpest, -1e-6) << "no sharp concave corner is left";
}

TEST(Outline, AllConcaveArcsButTheSlitsAreRoundedByThreeTenths)
{
    for (const Element& element : tests::table_elements()) {
        const HookParameters p = hook_parameters(element);
        for (const Segment& s : segments(*element_outline(p))) {
            if (s.bulge < 0 && std::abs(s.bulge + 1) > 1e-9) {
                EXPECT_GE(circle(s).radius, 0.3);
            }
        }
    }
}

TEST(Outline, RefusesWhatCannotBeDrawnAndNamesIt)
{
    struct Case
    {
        double HookParameters::*field;
        double value;
        const char* says;
    };
    const Case cases[] = {{&HookParameters::la, 20, "leave no room"},
                          {&HookParameters::lb, 15, "leaves no straight edge"},
                          {&HookParameters::neck_setback, 4, "reach across the node hole"},
                          {&HookParameters::lip_rounding, 5, "under the lip"},
                          {&HookParameters::neck_setback, 0.06, "too steep"},
                          {&HookParameters::scoop_depth, 0.1, "scoop depth"},
                          {&HookParameters::slit, -1, "must be positive"},
                          {&HookParameters::finger_width, std::nan(""), "must be positive"},
                          {&HookParameters::alpha, 2, "acute"}};
    for (const Case& c : cases) {
        HookParameters p = hook_parameters(Element{});
        p.*c.field = c.value;
        const auto refused = element_outline(p);
        ASSERT_FALSE(refused) << c.says;
        EXPECT_NE(refused.error().message.find(c.says), std::string::npos) << refused.error().message;
    }
}

} // namespace rhombloom
