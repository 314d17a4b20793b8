#include <algorithm>
#include <initializer_list>

#include "core/building/orders.h"

// The paper builds every closed shape to the end and reopens it. Here each reopening has to earn its steps: closing is
// kept only where it makes the whole easier, because on most models a hole left open costs less than it saves.

namespace rhombloom {

namespace {

constexpr int most_passes = 3;
constexpr double most_exposure = 1.05; // of the paper's, when the last element is given

double ratio(double value, double reference)
{
    return reference > 0 ? value / reference : value;
}

//! What a plan costs beside the paper's; 4 is about the same. Worse exposure than the paper's is all but forbidden, and
//! more than half of its reopened elements have to be worth it.
double cost(const Scorecard& s, const Scorecard& paper)
{
    const double exposure = ratio(static_cast<double>(s.exposure), static_cast<double>(paper.exposure));
    const double reopened = ratio(s.removals, std::max(1, paper.removals));
    return reopened + 3 * std::max(0.0, reopened - 0.5) + exposure + 8 * std::max(0.0, exposure - 1) +
           ratio(s.steps, paper.steps) +
           0.5 * ratio(s.one_neighbour_inserts, std::max(1, paper.one_neighbour_inserts)) +
           0.7 * ratio(s.view_turns, std::max(1, paper.view_turns)) + 0.01 * s.negative_defect_inserts;
}

struct Search
{
    const PlanSources& sources;
    Scorecard paper;
    Holes holes;
    AssemblyPlan best = {};
    double best_cost = 1e300;

    bool consider(const std::vector<char>& closed, const Taste& taste)
    {
        AssemblyPlan plan = finish_plan(
            sources, greedy_order(sources, open_targets(sources.history, holes, closed, sources.last), taste),
            Order::Best);
        const double its_cost = cost(plan.scorecard, paper);
        if (its_cost >= best_cost - 1e-9 || !plan_problems(sources.replay, sources.element, plan).empty()) {
            return false;
        }
        best_cost = its_cost;
        best = std::move(plan);
        return true;
    }
};

//! Closes a hole only where that pays: from all open (or all closed, when open ones do not work), changing one after
//! the other.
std::vector<char> choose_closings(Search& search, const Taste& taste)
{
    std::vector<char> closed(search.holes.count, 0);
    if (!search.consider(closed, taste)) {
        closed.assign(closed.size(), 1);
        search.consider(closed, taste);
    }
    bool better = true;
    for (int pass = 0; pass < most_passes && better; ++pass) {
        better = false;
        for (char& hole : closed) {
            hole = hole == 0;
            if (search.consider(closed, taste)) {
                better = true;
            } else {
                hole = hole == 0;
            }
        }
    }
    return closed;
}

//! Tries other values of one liking after the other, keeping what is better.
void choose_taste(Search& search, const std::vector<char>& closed)
{
    Taste taste;
    const auto vary = [&](double Taste::*liking, std::initializer_list<double> values) {
        for (const double value : values) {
            Taste other = taste;
            other.*liking = value;
            if (search.consider(closed, other)) {
                taste = other;
            }
        }
    };
    vary(&Taste::view, {0.0, 0.4, 0.7, 1.5, 2.5});
    vary(&Taste::last, {0.0, 0.1, 0.6});
    vary(&Taste::age, {0.0, 0.5, 1.0});
    vary(&Taste::dangling, {0.4, 2.0});
    vary(&Taste::view, {0.2, 0.5, 0.9, 1.2, 2.0});
}

} // namespace

AssemblyPlan best_plan(const PlanSources& sources)
{
    Search search{sources, finish_plan(sources, paper_order(sources), Order::Paper).scorecard, holes(sources.history)};
    const std::vector<char> closed = choose_closings(search, {});
    choose_taste(search, closed);
    if (search.best.steps.empty() && sources.last < 0) {
        return finish_plan(sources, paper_order(sources), Order::Best);
    }
    const bool too_open = static_cast<double>(search.best.scorecard.exposure) >
                          most_exposure * static_cast<double>(search.paper.exposure);
    return sources.last >= 0 && too_open ? AssemblyPlan() : std::move(search.best);
}

} // namespace rhombloom
