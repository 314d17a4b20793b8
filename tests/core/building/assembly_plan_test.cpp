#include "core/building/assembly_plan.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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
    all.push_back({"opened ball", replays::opened("ball-30")});
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

} // namespace rhombloom
