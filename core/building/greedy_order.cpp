#include <algorithm>
#include <memory>

#include "core/building/orders.h"
#include "core/building/viewpoints.h"

namespace rhombloom {

namespace {

//! One greedy run over one target.
class Greedy
{
public:
    Greedy(const BuildHistory& history, const Target& target, const Taste& taste, Sight& sight, BuildState& state,
           int& view)
        : history_(history), target_(target), taste_(taste), sight_(sight), state_(state), view_(view)
    {
        sight_.clear();
        for (std::size_t e = 0; e < state_.present.size(); ++e) {
            if (state_.present[e]) {
                sight_.place(face(static_cast<int>(e)));
            }
        }
    }

    void build(const std::vector<int>& batch)
    {
        for (int e = choose(batch); e >= 0; e = choose(batch)) {
            look_at(e, batch);
            insert(state_, history_, target_, e);
            sight_.place(face(e));
        }
    }

private:
    Face face(int e) const { return Face(target_.face[e]); }

    bool shown(int e, int view) const { return view >= 0 && sight_.visible(face(e), view) >= well_visible; }

    int joins(int e) const { return static_cast<int>(missing_joins(state_, target_, e).size()); }

    //! Oldest neighbour: old rims are closed before new ones are opened.
    double age(int e) const
    {
        int oldest = static_cast<int>(state_.steps.size());
        for (const Port& port : target_.ports[e]) {
            if (port.element >= 0 && state_.present[port.element]) {
                oldest = std::min(oldest, state_.inserted_at[port.element]);
            }
        }
        return 1 - static_cast<double>(oldest) / (1.0 + static_cast<double>(state_.steps.size()));
    }

    bool beside_last(int e) const
    {
        const Ports& ports = target_.ports[e];
        return state_.last >= 0 &&
               std::any_of(ports.begin(), ports.end(), [&](const Port& p) { return p.element == state_.last; });
    }

    double score(int e) const
    {
        const int b = joins(e);
        return b - (b == 1 ? taste_.dangling : 0) + (shown(e, view_) ? taste_.view : 0) +
               (beside_last(e) ? taste_.last : 0) + taste_.age * age(e);
    }

    int choose(const std::vector<int>& batch) const
    {
        std::vector<std::pair<double, int>> ranked;
        for (const int e : batch) {
            if (!state_.present[e] && (state_.last < 0 || joins(e) > 0)) {
                ranked.emplace_back(-score(e), e);
            }
        }
        if (ranked.empty()) { // nothing touches: the batch starts a piece of its own
            const auto absent = std::find_if(batch.begin(), batch.end(), [&](int e) { return !state_.present[e]; });
            return absent == batch.end() ? -1 : *absent;
        }
        std::sort(ranked.begin(), ranked.end());
        const auto safe = std::find_if(ranked.begin(), ranked.end(), [&](const auto& candidate) {
            return leaves_easy_plugs(state_, target_, candidate.second);
        });
        return (safe == ranked.end() ? ranked.front() : *safe).second;
    }

    //! Turn only when the element is not well visible; then to the view that shows most of what can come next.
    void look_at(int e, const std::vector<int>& batch)
    {
        if (shown(e, view_)) {
            return;
        }
        int best_count = -1;
        for (int view = 0; view < static_cast<int>(viewpoints().size()); ++view) {
            if (!shown(e, view)) {
                continue;
            }
            const auto next =
                std::count_if(batch.begin(), batch.end(), [&](int f) { return !state_.present[f] && shown(f, view); });
            if (next > best_count) {
                best_count = static_cast<int>(next);
                view_ = view;
            }
        }
    }

    const BuildHistory& history_;
    const Target& target_;
    const Taste& taste_;
    Sight& sight_;
    BuildState& state_;
    int& view_;
};

} // namespace

std::vector<Step> greedy_order(const PlanSources& sources, const std::vector<Target>& targets, const Taste& taste)
{
    const BuildHistory& history = sources.history;
    BuildState state = empty_state(history);
    int view = -1;
    for (const Target& target : targets) {
        reopen(state, target, chapter_of(state, history, target));
        Sight sight(sources.coverage(target.stage));
        Greedy greedy(history, target, taste, sight, state, view);
        for (auto waiting = batches(state, history, target); !waiting.empty();
             waiting = batches(state, history, target)) {
            greedy.build(waiting[next_batch(state, history, target, waiting)]);
        }
    }
    return std::move(state.steps);
}

} // namespace rhombloom
