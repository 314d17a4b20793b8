#include <algorithm>
#include <initializer_list>

#include "core/building/orders.h"
#include "core/form/parallel.h"

// The paper builds every closed shape to the end and reopens it. Here each reopening has to earn its steps: closing is
// kept only where it makes the whole easier, because on most models a hole left open costs less than it saves.

namespace rhombloom {

namespace {

constexpr int most_passes = 3;
constexpr double left_over_cost = 1;   // of an element that is cut and not in the final surface
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

//! A way to plan: which holes to close for a time, and what to like.
struct Choice
{
    std::vector<char> closed;
    Taste taste;
};

//! A plan and what it costs; no plan that obeys the hard rules costs more than any.
struct Candidate
{
    AssemblyPlan plan;
    double cost = 1e300;
};

struct Search
{
    const PlanSources& sources;
    Scorecard paper;
    Holes holes;
    Candidate best = {};

    Candidate planned(const Choice& choice) const
    {
        const auto targets = open_targets(sources.history, holes, choice.closed, sources.last);
        Candidate made;
        made.plan = finish_plan(sources, greedy_order(sources, targets, choice.taste), Order::Best);
        if (plan_problems(sources.replay, sources.element, made.plan).empty()) {
            const int left_over = made.plan.scorecard.parts_needed - sources.history.final_count;
            made.cost = cost(made.plan.scorecard, paper) + left_over_cost * left_over;
        }
        return made;
    }

    bool consider(Candidate candidate)
    {
        if (candidate.cost >= best.cost - 1e-9) {
            return false;
        }
        best = std::move(candidate);
        return true;
    }

    //! Plans all choices at once and keeps the first that is better; returns its index, or -1.
    int consider_first(const std::vector<Choice>& choices)
    {
        std::vector<Candidate> candidates = planned(choices);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (consider(std::move(candidates[i]))) {
                return static_cast<int>(i);
            }
        }
        return -1;
    }

    std::vector<Candidate> planned(const std::vector<Choice>& choices) const
    {
        std::vector<Candidate> candidates(choices.size());
        parallel_tasks(default_threads(), static_cast<int>(choices.size()),
                       [&](int i) { candidates[i] = planned(choices[i]); });
        return candidates;
    }
};

//! Goes through the holes once and changes those where that is better. Several are tried ahead at the same time; what
//! was tried before a change is tried again, so that the result is that of one after the other.
bool improve_closings(Search& search, std::vector<char>& closed, const Taste& taste)
{
    constexpr std::size_t ahead = 4;
    bool better = false;
    for (std::size_t first = 0; first < closed.size();) {
        std::vector<Choice> choices;
        for (std::size_t i = first; i < std::min(closed.size(), first + ahead); ++i) {
            choices.push_back({closed, taste});
            choices.back().closed[i] ^= 1;
        }
        const int found = search.consider_first(choices);
        if (found < 0) {
            first += choices.size();
        } else {
            closed = choices[found].closed;
            first += static_cast<std::size_t>(found) + 1;
            better = true;
        }
    }
    return better;
}

//! Closes a hole only where that pays: from all open (or all closed, when open ones do not work), changing one after
//! the other.
std::vector<char> choose_closings(Search& search, const Taste& taste)
{
    std::vector<char> closed(search.holes.count, 0);
    if (!search.consider(search.planned({closed, taste}))) {
        closed.assign(closed.size(), 1);
        search.consider(search.planned({closed, taste}));
    }
    for (int pass = 0; pass < most_passes && improve_closings(search, closed, taste); ++pass) {
    }
    return closed;
}

//! Tries other values of one liking after the other, keeping what is better.
void choose_taste(Search& search, const std::vector<char>& closed)
{
    Taste taste;
    const auto vary = [&](double Taste::*liking, std::initializer_list<double> values) {
        std::vector<Choice> choices;
        for (const double value : values) {
            choices.push_back({closed, taste});
            choices.back().taste.*liking = value;
        }
        std::vector<Candidate> candidates = search.planned(choices);
        for (std::size_t i = 0; i < choices.size(); ++i) {
            if (search.consider(std::move(candidates[i]))) {
                taste = choices[i].taste;
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
    if (search.best.plan.steps.empty() && sources.last < 0) {
        return finish_plan(sources, paper_order(sources), Order::Best);
    }
    const bool too_open = static_cast<double>(search.best.plan.scorecard.exposure) >
                          most_exposure * static_cast<double>(search.paper.exposure);
    return sources.last >= 0 && too_open ? AssemblyPlan() : std::move(search.best.plan);
}

} // namespace rhombloom
