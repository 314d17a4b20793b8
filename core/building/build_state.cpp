#include "core/building/build_state.h"

#include <algorithm>

namespace rhombloom {

namespace {

int count(const BuildState& state)
{
    return static_cast<int>(state.present.size());
}

void apply(BuildState& state, const Step& step, bool hook)
{
    for (const Join& join : step.joins) {
        state.hooked[step.element][join.side] = hook ? Port{join.to, join.to_side} : Port{};
        state.hooked[join.to][join.to_side] = hook ? Port{step.element, join.side} : Port{};
    }
    state.last = step.element;
    state.steps.push_back(step);
}

void remove(BuildState& state, int component, int element)
{
    Step step{StepKind::Remove, element, {}, component, state.stage};
    for (int k = 0; k < 4; ++k) {
        const Port& port = state.hooked[element][k];
        if (port.element >= 0) {
            step.joins.push_back({port.element, k, port.side});
        }
    }
    apply(state, step, false);
    state.present[element] = 0;
}

int degree(const BuildState& state, int element)
{
    const Ports& ports = state.hooked[element];
    return static_cast<int>(std::count_if(ports.begin(), ports.end(), [](const Port& p) { return p.element >= 0; }));
}

//! Present elements reachable from \p first by hooks that the target has too.
std::vector<char> lasting_piece(const BuildState& state, const Target& target, int first)
{
    std::vector<char> reached(count(state), 0);
    std::vector<int> open = {first};
    reached[first] = 1;
    while (!open.empty()) {
        const int e = open.back();
        open.pop_back();
        for (int k = 0; k < 4; ++k) {
            const Port& port = state.hooked[e][k];
            if (port.element >= 0 && port == target.ports[e][k] && !reached[port.element]) {
                reached[port.element] = 1;
                open.push_back(port.element);
            }
        }
    }
    return reached;
}

//! The largest piece that survives the change to the target; everything else has to come off.
std::vector<char> keepers(const BuildState& state, const Target& target)
{
    std::vector<char> best(count(state), 0);
    std::vector<char> seen(count(state), 0);
    long most = 0;
    for (int e = 0; e < count(state); ++e) {
        if (!state.present[e] || !target.has(e) || seen[e]) {
            continue;
        }
        const std::vector<char> piece = lasting_piece(state, target, e);
        const long size = std::count(piece.begin(), piece.end(), 1);
        for (int i = 0; i < count(state); ++i) {
            seen[i] |= piece[i];
        }
        if (size > most) {
            most = size;
            best = piece;
        }
    }
    return best;
}

//! The sides of an element whose hooks have to be undone.
std::vector<Join> stale_joins(const BuildState& state, const Target& target, const std::vector<char>& keep, int e)
{
    std::vector<Join> joins;
    for (int k = 0; k < 4; ++k) {
        const Port& port = state.hooked[e][k];
        if (port.element >= 0 && keep[e] && keep[port.element] && !(port == target.ports[e][k])) {
            joins.push_back({port.element, k, port.side});
        }
    }
    return joins;
}

//! Undo or make the connections between elements that stay, most at once first.
template <class JoinsOf>
void change_hooks(BuildState& state, int component, StepKind kind, const JoinsOf& joins_of)
{
    while (true) {
        Step best{kind, -1, {}, component, state.stage};
        for (int e = 0; e < count(state); ++e) {
            const std::vector<Join> joins = state.present[e] ? joins_of(e) : std::vector<Join>{};
            if (joins.size() > best.joins.size()) {
                best.element = e;
                best.joins = joins;
            }
        }
        if (best.element < 0) {
            return;
        }
        apply(state, best, kind == StepKind::Hook);
    }
}

int next_to_remove(const BuildState& state, const std::vector<char>& keep)
{
    int best = -1;
    for (int e = 0; e < count(state); ++e) {
        if (state.present[e] && !keep[e] && (best < 0 || degree(state, e) < degree(state, best)) &&
            holds_together(state, e)) {
            best = e;
        }
    }
    return best;
}

} // namespace

BuildState empty_state(const BuildHistory& history)
{
    BuildState state;
    state.present.assign(history.element_count(), 0);
    state.hooked.resize(history.element_count());
    state.inserted_at.assign(history.element_count(), -1);
    return state;
}

std::vector<Join> missing_joins(const BuildState& state, const Target& target, int element)
{
    std::vector<Join> joins;
    for (int k = 0; k < 4; ++k) {
        const Port& port = target.ports[element][k];
        if (port.element >= 0 && state.present[port.element] && state.hooked[port.element][port.side].element < 0 &&
            state.hooked[element][k].element < 0) {
            joins.push_back({port.element, k, port.side});
        }
    }
    return joins;
}

void insert(BuildState& state, const BuildHistory& history, const Target& target, int element)
{
    expects(!state.present[element] && target.has(element), "insert: an absent element of the target");
    state.present[element] = 1;
    state.stage = target.stage;
    state.inserted_at[element] = static_cast<int>(state.steps.size());
    apply(state,
          {StepKind::Insert, element, missing_joins(state, target, element), history.component[element], target.stage},
          true);
}

void reopen(BuildState& state, const Target& target, int component)
{
    const std::vector<char> keep = keepers(state, target);
    change_hooks(state, component, StepKind::Unhook, [&](int e) { return stale_joins(state, target, keep, e); });
    for (int e = next_to_remove(state, keep); e >= 0; e = next_to_remove(state, keep)) {
        remove(state, component, e);
    }
    state.stage = target.stage; // what was opened is drawn in the old shape, what comes now in the new one
    change_hooks(state, component, StepKind::Hook, [&](int e) { return missing_joins(state, target, e); });
}

bool holds_together(const BuildState& state, int leaving)
{
    std::vector<char> reached(count(state), 0);
    std::vector<int> open;
    for (int e = 0; e < count(state) && open.empty(); ++e) {
        if (state.present[e] && e != leaving) {
            open.push_back(e);
            reached[e] = 1;
        }
    }
    while (!open.empty()) {
        const int e = open.back();
        open.pop_back();
        for (const Port& port : state.hooked[e]) {
            if (port.element >= 0 && port.element != leaving && !reached[port.element]) {
                reached[port.element] = 1;
                open.push_back(port.element);
            }
        }
    }
    for (int e = 0; e < count(state); ++e) {
        if (state.present[e] && e != leaving && !reached[e]) {
            return false;
        }
    }
    return true;
}

int open_sides(const BuildState& state)
{
    int open = 0;
    for (int e = 0; e < count(state); ++e) {
        open += state.present[e] ? 4 - degree(state, e) : 0;
    }
    return open;
}

namespace {

bool easy_plug(const Target& target, int e)
{
    const Ports& ports = target.ports[e];
    return !target.hard[e] || std::any_of(ports.begin(), ports.end(), [](const Port& p) { return p.element < 0; });
}

//! Walks one hole from \p first, never through \p closed; marks \p seen. Does it hold an easy plug?
bool hole_has_easy_plug(const BuildState& state, const Target& target, int first, int closed, std::vector<char>& seen)
{
    bool easy = false;
    std::vector<int> open = {first};
    seen[first] = 1;
    while (!open.empty()) {
        const int e = open.back();
        open.pop_back();
        easy = easy || easy_plug(target, e);
        for (const Port& port : target.ports[e]) {
            const int f = port.element;
            if (f >= 0 && f != closed && !state.present[f] && !seen[f]) {
                seen[f] = 1;
                open.push_back(f);
            }
        }
    }
    return easy;
}

} // namespace

bool leaves_easy_plugs(const BuildState& state, const Target& target, int element)
{
    std::vector<char> seen(count(state), 0);
    if (!hole_has_easy_plug(state, target, element, -1, seen)) {
        return true;
    }
    std::fill(seen.begin(), seen.end(), 0);
    bool last_of_hole = true;
    for (const Port& port : target.ports[element]) {
        const int f = port.element;
        if (f >= 0 && !state.present[f]) {
            last_of_hole = false;
            if (!seen[f] && !hole_has_easy_plug(state, target, f, element, seen)) {
                return false;
            }
        }
    }
    return !last_of_hole || easy_plug(target, element);
}

} // namespace rhombloom
