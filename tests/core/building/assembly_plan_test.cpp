#include "core/building/assembly_plan.h"

#include <array>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/building/bulb_hatch.h"
#include "core/building/scorecard.h"
#include "tests/core/building/replays.h"

namespace rhombloom {

namespace {

const Element element;

struct Case
{
    std::string name;
    Replay replay;
};

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const char* name : {"ball-30", "polar-3x3", "rhombic-6", "rhombic-12", "ball-90", "tube-6x4", "torus-12x6",
                             "dome-5x3", "sheet-4x6"}) {
        all.push_back({name, replays::single(name)});
    }
    all.push_back({"two balls", replays::chain("ball-30", 2)});
    all.push_back({"three balls", replays::chain("ball-90", 3)});
    all.push_back({"opened ball", replays::opened(replays::single("ball-30"), 29)});
    return all;
}

std::string listing(const std::vector<std::string>& problems)
{
    std::string text;
    for (const std::string& p : problems) {
        text += p + "\n";
    }
    return text;
}

} // namespace

TEST(AssemblyPlan, ObeysTheHardRules)
{
    for (const Case& c : cases()) {
        for (const Order order : {Order::Paper, Order::Best}) {
            const AssemblyPlan plan = assembly_plan(c.replay, element, order);
            EXPECT_EQ(listing(plan_problems(c.replay, element, plan)), "") << c.name << (order == Order::Paper);
        }
    }
}

TEST(AssemblyPlan, HasOneStepForEachInsertAndRemoval)
{
    for (const Case& c : cases()) {
        const AssemblyPlan plan = assembly_plan(c.replay, element, Order::Paper);
        const auto& s = plan.scorecard;
        EXPECT_EQ(s.inserts, static_cast<int>(c.replay.surface.n_faces()) + s.removals) << c.name;
        EXPECT_EQ(s.steps, s.inserts + s.removals) << c.name;
    }
}

// Chains of shapes with openings here and there, each at a random place.
TEST(AssemblyPlan, ObeysTheHardRulesOnRandomChainsWithOpenings)
{
    std::mt19937 random(5);
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    const std::array names = {"ball-30", "rhombic-12", "polar-4x6"};
    for (int i = 0; i < 12; ++i) {
        const char* name = names[i % names.size()];
        Replay replay = replays::chain(name, 1 + below(3));
        for (int openings = below(3); openings > 0; --openings) {
            replay = replays::opened(std::move(replay), below(1000));
        }
        for (const Order order : {Order::Paper, Order::Best}) {
            const AssemblyPlan plan = assembly_plan(replay, element, order);
            EXPECT_EQ(listing(plan_problems(replay, element, plan)), "") << name << " " << i;
        }
    }
}

// What lies open in the end is left open from the start: no element is cut to be taken out again.
TEST(AssemblyPlan, CutsNothingForAnOpening)
{
    for (const char* name : {"ball-30", "polar-4x6"}) {
        for (const int opening : {0, 7, 29}) {
            const Replay replay = replays::opened(replays::chain(name, 3), opening);
            const AssemblyPlan plan = assembly_plan(replay, element, Order::Best);
            EXPECT_EQ(plan.scorecard.parts_needed, static_cast<int>(replay.surface.n_faces())) << name << opening;
        }
    }
}

// Every spoilt plan is told: a step left out, two dependent steps exchanged, a join dropped, an element repeated.
RC_GTEST_PROP(AssemblyPlan, IsRefusedWhenSpoilt, ())
{
    static const Replay replay = replays::chain("ball-30", 2);
    static const AssemblyPlan good = assembly_plan(replay, element, Order::Paper);
    AssemblyPlan plan = good;
    const int k = *rc::gen::inRange(1, static_cast<int>(plan.steps.size()));
    switch (*rc::gen::inRange(0, 3)) {
    case 0:
        plan.steps.erase(plan.steps.begin() + k);
        break;
    case 1:
        plan.steps[k].joins.pop_back();
        break;
    default:
        plan.steps.push_back(plan.steps[k]);
    }
    RC_ASSERT(!plan_problems(replay, element, plan).empty());
}

TEST(AssemblyPlan, EndsBesideTheNamedHatch)
{
    Design design;
    design.operations = {Place{"body", "ball-30"}, Open{"body", {}, "Bulb hatch"}};
    const Replay replay = replays::opened(replays::single("ball-30"), 7);
    const std::vector<int> beside = hatch_elements(design, replay, element);
    EXPECT_EQ(beside.size(), 4U);
    const AssemblyPlan plan = design_plan(design, replay, element, Order::Best);
    EXPECT_EQ(std::count(beside.begin(), beside.end(), plan.steps.back().element), 1);
    EXPECT_EQ(plan.steps.back().kind, StepKind::Insert);
    EXPECT_EQ(listing(plan_problems(replay, element, plan)), "");
}

TEST(NamedOpenings, TellWhatIsRoundThem)
{
    Design design;
    design.operations = {Place{"body", "ball-30"}, Open{"body", {}, "lamp holder"}};
    const Replay replay = replays::opened(replays::single("ball-30"), 7);
    const auto found = named_openings(design, replay);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].purpose, "lamp holder");
    EXPECT_EQ(found[0].beside.size(), 4U);
    for (const int f : found[0].beside) {
        EXPECT_TRUE(replay.surface.is_boundary(Face(f)));
    }
    design.operations[1] = Open{"body", {}, ""};
    EXPECT_TRUE(named_openings(design, replay).empty());
}

} // namespace rhombloom
