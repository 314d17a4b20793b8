#include <algorithm>

#include "core/building/orders.h"

// The paper builds every closed shape to the end and reopens it. Here each reopening has to earn its steps: closing is
// kept only where it makes the whole easier, because on most models a hole left open costs less than it saves.

namespace rhombloom {

namespace {

double ratio(double value, double reference)
{
    return reference > 0 ? value / reference : value;
}

//! What a plan costs beside the paper's; 3 is about the same. Worse exposure than the paper's is all but forbidden.
double cost(const Scorecard& s, const Scorecard& paper)
{
    const double exposure = ratio(static_cast<double>(s.exposure), static_cast<double>(paper.exposure));
    return exposure + 8 * std::max(0.0, exposure - 1) + ratio(s.steps, paper.steps) +
           0.5 * ratio(s.one_neighbour_inserts, std::max(1, paper.one_neighbour_inserts)) +
           0.7 * ratio(s.view_turns, std::max(1, paper.view_turns)) + 0.01 * s.negative_defect_inserts;
}

struct Search
{
    const PlanSources& sources;
    Scorecard paper;
    AssemblyPlan best = {};
    double best_cost = 1e300;

    bool consider(const std::vector<char>& closed, const Taste& taste)
    {
        if (!first_island(sources.history, closed).empty()) {
            return false;
        }
        AssemblyPlan plan = finish_plan(sources, greedy_order(sources, closed, taste), Order::Best);
        const double its_cost = cost(plan.scorecard, paper);
        if (its_cost >= best_cost - 1e-9) {
            return false;
        }
        best_cost = its_cost;
        best = std::move(plan);
        return true;
    }
};

//! The fewest closings, earliest first, with which nothing that is built falls into islands.
std::vector<char> needed_closings(const BuildHistory& history)
{
    std::vector<char> closed(history.targets.size(), 0);
    for (auto island = first_island(history, closed); !island.empty(); island = first_island(history, closed)) {
        closed[island.front()] = 1;
    }
    return closed;
}

//! Closes a target only where that pays.
std::vector<char> choose_closings(Search& search, const Taste& taste)
{
    std::vector<char> closed = needed_closings(search.sources.history);
    search.consider(closed, taste);
    for (std::size_t t = 0; t + 1 < closed.size(); ++t) {
        const char needed = closed[t];
        closed[t] = 1;
        if (!needed && !search.consider(closed, taste)) {
            closed[t] = 0;
        }
    }
    return closed;
}

} // namespace

AssemblyPlan best_plan(const PlanSources& sources)
{
    Search search{sources, finish_plan(sources, paper_order(sources), Order::Paper).scorecard};
    const std::vector<char> closed = choose_closings(search, {});
    for (const double view : {0.0, 0.4, 0.8, 1.5, 2.5}) {
        for (const double last : {0.1, 0.5}) {
            search.consider(closed, {view, last, 1});
        }
    }
    return std::move(search.best);
}

} // namespace rhombloom
