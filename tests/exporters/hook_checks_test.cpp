#include "exporters/hook_checks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "clipper_tools.h"
#include "exporters/hook_measures.h"
#include "exporters/materials.h"
#include "exporters/parameter_table.h"
#include "table_elements.h"

namespace rhombloom {

namespace {

HookParameters with(const std::vector<ParameterSetting>& settings, const Element& element = {})
{
    return piece_parameters(element, settings)->hook;
}

HookCheck find(const std::vector<HookCheck>& checks, const std::string& id)
{
    for (const HookCheck& check : checks) {
        if (check.id == id) {
            return check;
        }
    }
    return {};
}

HookCheck checked(const HookParameters& parameters, const std::string& id, const HookCheckOptions& options = {})
{
    return find(hook_checks(parameters, options), id);
}

//! How often element 0 overlaps element \p other of a flat node of acute corners, within the reach of the hooks.
int planar_node(const HookParameters& p, int elements, int other)
{
    const Path outline = *element_outline(p);
    const double reach = pivot_radius(p) + p.slit / 2 + p.finger_length + p.finger_width;
    const double step = two_pi / elements;
    ClipperLib::Paths disc = {tests::to_clipper(Path{{{{-reach, 0}, 1}, {{reach, 0}, 1}}, true}, 1e-3)};
    const ClipperLib::Paths a = {tests::to_clipper(outline, 1e-3)};
    const ClipperLib::Paths b = {tests::to_clipper(placed(outline, other * step, Vec2::Zero()), 1e-3)};
    const auto overlap = tests::clipper_combine(ClipperLib::ctIntersection,
                                                tests::clipper_combine(ClipperLib::ctIntersection, a, b), disc);
    int count = 0;
    for (const auto& piece : overlap) {
        count += tests::clipper_area({piece}) > 1e-3;
    }
    return count;
}

} // namespace

TEST(HookChecks, EveryTableElementPassesAllThirteen)
{
    for (const Element& element : tests::table_elements()) {
        const auto checks = hook_checks(hook_parameters(element));
        ASSERT_EQ(checks.size(), 13u);
        for (std::size_t i = 0; i < checks.size(); ++i) {
            EXPECT_EQ(checks[i].id, "C" + std::to_string(i + 1));
            EXPECT_TRUE(checks[i].ok) << "la " << element.la << " " << checks[i].id << ": " << checks[i].sentence;
        }
    }
}

TEST(HookChecks, DefaultPieceHasThePublishedMeasures)
{
    const auto checks = hook_checks(hook_parameters(Element{}));
    EXPECT_NEAR(find(checks, "C2").value, 4.4, 0.01);
    EXPECT_NEAR(find(checks, "C5").value, 9.24, 1e-9);
    EXPECT_NEAR(find(checks, "C7").value, 10.178, 1e-3);
    EXPECT_NEAR(find(checks, "C8").value, 41.36, 1e-9);
    EXPECT_NEAR(find(checks, "C10").value, 2.304, 1e-3);
    const Bow b = bow(88 - 2 * 9.68, 80 - 2 * 9.68);
    EXPECT_NEAR(b.sagitta, 13.7507, 1e-4);
    EXPECT_NEAR(b.radius, 40.3028, 1e-4);
    EXPECT_NEAR(degrees(b.slope), 48.8, 0.05);
}

TEST(HookChecks, BowedArcHasTheRightLengthAndChord)
{
    for (const double ratio : {1.001, 1.1, 1.4, 2.0}) {
        const Bow b = bow(60 * ratio, 60);
        EXPECT_NEAR(2 * b.radius * b.slope, 60 * ratio, 1e-9);
        EXPECT_NEAR(2 * b.radius * std::sin(b.slope), 60, 1e-6);
        EXPECT_NEAR(b.sagitta, b.radius * (1 - std::cos(b.slope)), 1e-6);
    }
}

TEST(HookChecks, DefaultJointIsHeldInEveryDirection)
{
    const HookParameters p = hook_parameters(Element{});
    const Interlock lock = interlock(p, *element_outline(p));
    EXPECT_EQ(lock.fingers, 2);
    EXPECT_EQ(lock.lips, 2);
    EXPECT_FALSE(lock.crossed);
    const auto travel = [&](int degree) { return lock.travel[static_cast<std::size_t>(degree / 15)]; };
    EXPECT_NEAR(travel(0), p.seat_clearance, 0.005);
    EXPECT_NEAR(travel(180), p.seat_clearance, 0.005);
    EXPECT_LT(travel(45), 0.1);
    EXPECT_LT(travel(90), 0.3);
    // The neck passes the slit's bottom where the shoulder does.
    const double inwards = p.neck_setback + std::sqrt(p.seat_clearance * (p.slit - p.seat_clearance));
    EXPECT_NEAR(travel(270), inwards, 0.005);
}

TEST(HookChecks, WithoutABarbThePieceComesOutStraightOnly)
{
    const HookParameters p = with({{"barb", 0}});
    const Interlock lock = interlock(p, *element_outline(p));
    EXPECT_EQ(lock.travel[90 / 15], 1);
    EXPECT_LT(lock.travel[75 / 15], 0.5);
    EXPECT_TRUE(checked(p, "C12").ok);
}

struct Mutation
{
    const char* id;
    std::vector<ParameterSetting> settings;
    const char* says;
};

TEST(HookChecks, ABrokenParameterFailsItsOwnCheckAndSaysWhatToChange)
{
    const Mutation mutations[] = {
        {"C2", {{"thickness", 0.8}, {"slit_clearance", 0.3}, {"finger_width", 2.3}}, "make the finger width larger"},
        {"C3", {{"thickness", 0.8}, {"finger_length", 4}, {"finger_width", 4.4}}, "make the slit clearance or"},
        {"C5", {{"finger_length", 1}, {"finger_width", 3}}, "make the finger length larger"},
        {"C5", {{"thickness", 0.8}, {"lip", 2}}, "make the lip larger"},
        {"C6", {{"lip", 7}}, "make alpha or the hole radius larger"},
        {"C7", {{"alpha", 50}, {"hole_radius", 2.5}}, "make the hole radius"},
        {"C8", {{"finger_length", 17}}, "make the finger width or the finger length smaller"},
        {"C9", {{"lb", 116}}, "make lb shorter"},
        {"C10", {{"lb", 95}}, "make the finger length larger, lb shorter"},
        {"C12", {{"seat_clearance", 0.5}, {"barb", 0.05}}, "make the barb larger"},
        {"C12", {{"neck_setback", 1.5}}, "make the neck setback smaller"},
    };
    for (const Mutation& m : mutations) {
        const HookCheck found = checked(with(m.settings), m.id);
        EXPECT_FALSE(found.ok) << m.id << ": " << found.sentence;
        EXPECT_NE(found.sentence.find(m.says), std::string::npos) << m.id << ": " << found.sentence;
    }
}

// NaN, with which no parameter is accepted, when the words are missing.
double number_after(const std::string& words, const std::string& sentence)
{
    const std::size_t place = sentence.find(words);
    EXPECT_NE(place, std::string::npos) << sentence;
    return place == std::string::npos ? std::nan("") : std::stod(sentence.substr(place + words.size()));
}

TEST(HookChecks, TheLongSideThatC9NamesIsTheLongestThatPasses)
{
    const Element wide{.la = 200, .lb = 300, .alpha = radians(50), .thickness = 0.8};
    const std::string sentence = checked(with({}, wide), "C9").sentence;
    const double lb = number_after("make lb shorter (", sentence);
    EXPECT_TRUE(checked(with({{"lb", lb}}, wide), "C9").ok) << lb;
    EXPECT_FALSE(checked(with({{"lb", lb + 0.2}}, wide), "C9").ok) << lb;
}

TEST(HookChecks, TheFingerLengthThatC10NamesIsTheLeastThatBears)
{
    const Element thick{.la = 81.1, .lb = 99.2, .alpha = radians(59.2), .thickness = 0.57};
    const std::string sentence = checked(with({}, thick), "C10").sentence;
    const double length = number_after("a finger length of ", sentence);
    EXPECT_TRUE(checked(with({{"finger_length", length}}, thick), "C10").ok);
    EXPECT_FALSE(checked(with({{"finger_length", length - 0.1}}, thick), "C10").ok);
}

TEST(HookChecks, AThroatWithoutPlayFailsC3)
{
    HookParameters p = hook_parameters(Element{});
    p.slit = p.thickness + 0.05;
    EXPECT_FALSE(checked(p, "C3").ok);
}

TEST(HookChecks, AKerfThatMeetsItselfInTheSlitFailsC4)
{
    HookCheckOptions options;
    options.kerf = {0.78, 0.78};
    const HookCheck found = checked(hook_parameters(Element{}), "C4", options);
    EXPECT_FALSE(found.ok);
    EXPECT_NE(found.sentence.find("0.02 mm wider than the kerf"), std::string::npos) << found.sentence;
    options.kerf = {0.4, 0.4};
    EXPECT_TRUE(checked(hook_parameters(Element{}), "C4", options).ok);
}

TEST(HookChecks, AContourThatCrossesItselfFailsC1)
{
    HookParameters p = hook_parameters(Element{});
    p.scoop_depth = 100; // the soft curves of both sides meet
    EXPECT_FALSE(checked(p, "C1").ok);
    p = hook_parameters(Element{});
    p.finger_width = 40;
    EXPECT_FALSE(checked(p, "C1").ok);
}

TEST(HookChecks, HooksThatDifferFailC11)
{
    const HookParameters p = hook_parameters(Element{});
    Path outline = *element_outline(p);
    EXPECT_LT(flip_mismatch(p, outline), 1e-9);
    for (PathVertex& v : outline.vertices) {
        if ((v.point - Vec2(p.lb, 0)).norm() < 2 * pivot_radius(p)) {
            v.point.x() += 0.01;
        }
    }
    EXPECT_GT(flip_mismatch(p, outline), 0.005);
}

TEST(HookChecks, RigidEndsThatOverlapCrossInThePlanView)
{
    HookParameters p = hook_parameters(Element{});
    const Path outline = *element_outline(p);
    const auto overlap = [&] {
        const std::vector<Vec2> plan = bowed_plan(p, outline);
        const ClipperLib::Paths raw = {tests::to_clipper(plan)};
        ClipperLib::Paths simple;
        ClipperLib::SimplifyPolygons(raw, simple);
        return simple.size();
    };
    EXPECT_EQ(overlap(), 1u);
    p.la = 10; // shorter than the scoops are deep
    EXPECT_GT(overlap(), 1u);
}

TEST(HookChecks, CardBearsLessStrainThanPolypropylene)
{
    HookCheckOptions card;
    card.strain_limit = 0.005;
    EXPECT_FALSE(check(hook_parameters(Element{}), card));
    EXPECT_EQ(check(hook_parameters(Element{}), card).error().message.find("hook check C10 (bending strain): "), 0u);
    EXPECT_TRUE(check(hook_parameters(Element{})));
    card = {};
    card.finger_strain_limit = 0.01;
    EXPECT_NE(check(hook_parameters(Element{}), card).error().message.find("2.3 % in the fingers (1 %)"),
              std::string::npos);
}

TEST(HookChecks, TheDefaultElementCanBeMadeOfEveryPresetUpToHalfAMillimetre)
{
    const std::vector<Material> presets = *materials();
    for (const Material& material : presets) {
        Element element;
        element.thickness = material.thickness;
        const HookCheckOptions options{{}, material.strain_limit, material.finger_strain_limit};
        EXPECT_EQ(check(hook_parameters(element), options).has_value(), material.thickness <= 0.5) << material.name;
    }
}

// Thick sheets on small pieces are the strain check's matter: the material's limit is set aside here.
TEST(HookChecks, TheCornersOfTheRangePass)
{
    HookCheckOptions options;
    options.strain_limit = 0.12;
    options.finger_strain_limit = 0.12;
    for (const double la : {40.0, 200.0}) {
        for (const double alpha : {50.0, 80.0}) {
            for (const double t : {0.2, 0.8}) {
                for (const double ratio : {1.03, 1.15}) {
                    const auto ok = check(hook_parameters(tests::element_of(la, t, ratio, alpha)), options);
                    EXPECT_TRUE(ok) << la << " " << alpha << " " << t << " " << ratio << ": " << ok.error().message;
                }
            }
        }
    }
}

// Elements round a node in one plane: neighbours overlap in one finger and one lip, others not at all.
TEST(HookChecks, PlanarNodesHaveTwoLayersAtMost)
{
    for (const auto& [elements, alpha_deg] : {std::pair{5, 72.0}, std::pair{6, 60.0}}) {
        const HookParameters p = hook_parameters(tests::element_of(80, 0.5, 1.1, alpha_deg));
        EXPECT_EQ(planar_node(p, elements, 1), 2) << elements;
        EXPECT_EQ(planar_node(p, elements, 2), 0) << elements;
    }
    // A lip that C6 refuses reaches under the finger of the element after next.
    const Element seven = tests::element_of(80, 0.5, 1.1, 360.0 / 7);
    const HookParameters wide = with({{"lip", 6}}, seven);
    EXPECT_FALSE(checked(wide, "C6").ok);
    EXPECT_GT(planar_node(wide, 7, 2), 0);
    EXPECT_TRUE(checked(hook_parameters(seven), "C6").ok);
    EXPECT_EQ(planar_node(hook_parameters(seven), 7, 2), 0);
}

} // namespace rhombloom
