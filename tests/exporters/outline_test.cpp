#include "exporters/outline.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "table_elements.h"

namespace rhombloom {

namespace {

using Points = std::vector<Vec2>;

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b)
{
    const Vec2 ab = b - a;
    const double t = ab.squaredNorm() > 0 ? std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0.0;
    return (p - a - t * ab).norm();
}

double distance_to_polygon(const Vec2& p, const Points& polygon)
{
    double best = 1e300;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        best = std::min(best, distance_to_segment(p, polygon[i], polygon[(i + 1) % polygon.size()]));
    }
    return best;
}

double one_sided_distance(const Points& from, const Points& to)
{
    double worst = 0;
    for (const Vec2& p : from) {
        worst = std::max(worst, distance_to_polygon(p, to));
    }
    return worst;
}

//! Points every \p step mm along the polygon's edges.
Points densified(const Points& polygon, double step)
{
    Points dense;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2& a = polygon[i];
        const Vec2& b = polygon[(i + 1) % polygon.size()];
        const int pieces = std::max(1, static_cast<int>((b - a).norm() / step));
        for (int k = 0; k < pieces; ++k) {
            dense.push_back(a + (b - a) * k / pieces);
        }
    }
    return dense;
}

//! Turn of the polygon at vertex i, radians, if it was sampled from a curve there (equal chords, no corner), else 0.
double sampled_turn(const Points& polygon, std::size_t i)
{
    const std::size_t n = polygon.size();
    const Vec2 a = polygon[i] - polygon[(i + n - 1) % n];
    const Vec2 b = polygon[(i + 1) % n] - polygon[i];
    const double turn = std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
    const bool sampled = std::abs(a.norm() - b.norm()) < 0.1 * a.norm() && turn < radians(16);
    return sampled ? turn : 0;
}

//! Distance to the nearest chord, less the sagitta of the arc which that chord was sampled from.
double distance_beyond_sampling(const Vec2& p, const Points& polygon)
{
    double best = 1e300;
    double beyond = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t j = (i + 1) % polygon.size();
        const double distance = distance_to_segment(p, polygon[i], polygon[j]);
        if (distance < best) {
            const double turn = std::max(sampled_turn(polygon, i), sampled_turn(polygon, j));
            best = distance;
            beyond = distance - (polygon[j] - polygon[i]).norm() * turn / 8;
        }
    }
    return beyond;
}

struct Reference
{
    Points outline;
    HookParameters parameters;
};

Reference load_reference()
{
    std::ifstream file(RHOMBLOOM_SOURCE_DIR "/tests/exporters/data/element_outline_reference.json");
    const nlohmann::json json = nlohmann::json::parse(file);
    Reference reference;
    for (const auto& p : json["outline"]) {
        const Vec2 point(p[0], p[1]);
        if (reference.outline.empty() || (point - reference.outline.back()).norm() > 1e-6) {
            reference.outline.push_back(point);
        }
    }
    reference.outline.pop_back(); // repeats the first
    const auto& p = json["params"];
    Element element;
    element.alpha = p["alpha"];
    reference.parameters = hook_parameters(element);
    return reference;
}

} // namespace

TEST(Outline, DefaultProportionsAreThoseOfTheReference)
{
    std::ifstream file(RHOMBLOOM_SOURCE_DIR "/tests/exporters/data/element_outline_reference.json");
    const nlohmann::json json = nlohmann::json::parse(file)["params"];
    const HookParameters p = hook_parameters(Element{});
    const std::pair<const char*, double> pairs[] = {
        {"la", p.la},           {"lb", p.lb},           {"t", p.thickness},      {"s", p.slit},
        {"w", p.finger_width},  {"ri", p.hole_radius},  {"Rp", pivot_radius(p)}, {"e", p.finger_length},
        {"eta", p.finger_turn}, {"m", p.lip},           {"cn", p.neck_setback},  {"cs", p.seat_clearance},
        {"b", p.barb},          {"rs", p.lip_rounding}, {"q", p.scoop_depth}};
    for (const auto& [name, value] : pairs) {
        EXPECT_NEAR(value, json[name].get<double>(), 1e-9) << name;
    }
}

TEST(Outline, EveryReferencePointLiesOnTheContour)
{
    const Reference reference = load_reference();
    const auto outline = element_outline(reference.parameters);
    ASSERT_TRUE(outline);
    const double worst = one_sided_distance(reference.outline, flatten(*outline, 1e-6));
    RecordProperty("worst_mm", std::to_string(worst));
    EXPECT_LT(worst, 0.0035); // the seat's rounding; all other points within 2e-5
}

TEST(Outline, TheContourLeavesTheReferenceByNoMoreThanTheReferencesOwnChords)
{
    // A chord of the sampled reference leaves its own curve by length * turn / 8, up to 0.0132 mm.
    const Reference reference = load_reference();
    const auto outline = element_outline(reference.parameters);
    ASSERT_TRUE(outline);
    double worst = 0;
    for (const Vec2& p : densified(flatten(*outline, 1e-6), 0.05)) {
        worst = std::max(worst, distance_beyond_sampling(p, reference.outline));
    }
    RecordProperty("worst_mm", std::to_string(worst));
    EXPECT_LT(worst, 0.0035);
}

TEST(Outline, EveryTableElementHasACounterClockwiseContour)
{
    for (const Element& element : tests::table_elements()) {
        const auto outline = element_outline(hook_parameters(element));
        ASSERT_TRUE(outline) << outline.error().message;
        EXPECT_GT(area(*outline), 0.7 * element.la * element.lb * std::sin(element.alpha));
    }
}

TEST(Outline, ScoopArcsStayWithinTwoMicrometresOfTheCubic)
{
    for (const Element& element : tests::table_elements()) {
        const HookParameters p = hook_parameters(element);
        const Points points = flatten(*element_outline(p), 1e-6);
        const Vec2 along(std::cos(p.alpha), std::sin(p.alpha));
        double worst = 0;
        for (int i = 0; i <= 300; ++i) {
            const Vec2 s = scoop_point(p, i / 300.0);
            const Vec2 q = Vec2(p.lb, 0) + s.x() * along + s.y() * Vec2(along.y(), -along.x());
            worst = std::max(worst, distance_to_polygon(q, points));
        }
        EXPECT_LT(worst, 0.002) << element.la;
    }
}

} // namespace rhombloom
