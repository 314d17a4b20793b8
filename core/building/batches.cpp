#include <algorithm>
#include <map>

#include "core/building/orders.h"

namespace rhombloom {

namespace {

std::vector<int> connected_batch(const BuildState& state, const BuildHistory& history, const Target& target, int first,
                                 std::vector<char>& taken)
{
    std::vector<int> batch = {first};
    taken[first] = 1;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        for (const Port& port : target.ports[batch[i]]) {
            const int e = port.element;
            if (e >= 0 && !taken[e] && !state.present[e] && history.component[e] == history.component[first]) {
                taken[e] = 1;
                batch.push_back(e);
            }
        }
    }
    std::sort(batch.begin(), batch.end());
    return batch;
}

} // namespace

std::vector<std::vector<int>> batches(const BuildState& state, const BuildHistory& history, const Target& target)
{
    std::vector<char> taken(state.present.size(), 0);
    std::vector<std::vector<int>> result;
    for (int e = 0; e < history.element_count(); ++e) {
        if (target.has(e) && !state.present[e] && !taken[e]) {
            result.push_back(connected_batch(state, history, target, e, taken));
        }
    }
    std::stable_sort(result.begin(), result.end(), [&](const auto& a, const auto& b) {
        return history.component[a.front()] < history.component[b.front()];
    });
    return result;
}

std::size_t next_batch(const BuildState& state, const BuildHistory& history, const Target& target,
                       const std::vector<std::vector<int>>& waiting)
{
    const auto touches = [&](const std::vector<int>& batch) {
        return std::any_of(batch.begin(), batch.end(), [&](int e) { return !missing_joins(state, target, e).empty(); });
    };
    const auto component = [&](std::size_t i) { return history.component[waiting[i].front()]; };
    std::size_t first = waiting.size(); // that touches
    for (std::size_t i = 0; i < waiting.size(); ++i) {
        if (!touches(waiting[i])) {
            continue;
        }
        first = std::min(first, i);
        std::size_t k = 0; // would another batch of the component have to wait?
        while (k < waiting.size() && (component(k) != component(i) || touches(waiting[k]))) {
            ++k;
        }
        if (k == waiting.size()) {
            return i;
        }
    }
    return first == waiting.size() ? 0 : first;
}

int chapter_of(const BuildState& state, const BuildHistory& history, const Target& target)
{
    const auto coming = batches(state, history, target);
    if (!coming.empty()) {
        return history.component[coming[next_batch(state, history, target, coming)].front()];
    }
    return state.last < 0 ? 0 : history.component[state.last];
}

AssemblyPlan finish_plan(const PlanSources& sources, std::vector<Step> steps, Order order)
{
    const BuildHistory& history = sources.history;
    std::map<int, int> number; // temporary element -> its number in the plan
    AssemblyPlan plan;
    plan.order = order;
    for (const Step& step : steps) {
        if (step.element >= history.final_count) {
            number.emplace(step.element, 0);
        }
    }
    int next = history.final_count;
    for (auto& [old, fresh] : number) {
        fresh = next++;
        plan.temporary.push_back(history.temporary[old - history.final_count]);
        plan.temporary.back().element = fresh;
    }
    const auto renumber = [&](int& e) { e = e < history.final_count ? e : number.at(e); };
    for (Step& step : steps) {
        renumber(step.element);
        for (Join& join : step.joins) {
            renumber(join.to);
        }
    }
    plan.steps = std::move(steps);
    plan.scorecard = scorecard(sources.replay, sources.element, plan, sources.coverage);
    return plan;
}

} // namespace rhombloom
