#include "core/building/bulb_hatch.h"

#include <algorithm>
#include <limits>
#include <set>

#include "core/building/orders.h"
#include "core/building/viewpoints.h"
#include "core/model/angular_defect.h"
#include "core/model/regions.h"

namespace rhombloom {

namespace {

bool is_hatch(const Operation& operation)
{
    const auto* open = std::get_if<Open>(&operation);
    return open != nullptr && names_hatch(open->purpose);
}

std::set<int> serials(const Surface& surface)
{
    std::set<int> result;
    for (const Face f : surface.faces()) {
        result.insert(surface.data(f).serial);
    }
    return result;
}

//! The faces that the operation of \p stage took away, one list for each hole.
std::vector<std::vector<Face>> holes_made(const Surface& before, const Surface& after)
{
    const std::set<int> left = serials(after);
    std::vector<char> stays(before.n_faces(), 0);
    for (const Face f : before.faces()) {
        stays[f.idx()] = left.contains(before.data(f).serial);
    }
    return connected_regions(before, std::move(stays));
}

//! Serials of the elements that share a side with one of the hole.
std::set<int> serials_beside(const std::vector<Face>& hole, const Surface& before)
{
    std::set<int> beside;
    for (const Face f : hole) {
        for (const Face g : before.ff_range(f)) {
            beside.insert(before.data(g).serial);
        }
    }
    return beside;
}

//! Serials of the elements beside anything that the operation of \p stage took away.
std::set<int> beside_opening(const Replay& replay, int stage)
{
    const Surface& before = stage_surface(replay, stage - 1);
    std::set<int> result;
    for (const auto& hole : holes_made(before, stage_surface(replay, stage))) {
        result.merge(serials_beside(hole, before));
    }
    return result;
}

//! The faces of \p surface that once shared a side with the hole and are on a rim still.
std::vector<int> rim_of(const std::vector<Face>& hole, const Surface& before, const Surface& surface)
{
    const std::set<int> beside = serials_beside(hole, before);
    std::vector<int> faces;
    for (const Face f : surface.faces()) {
        if (beside.contains(surface.data(f).serial) && surface.is_boundary(f)) {
            faces.push_back(f.idx());
        }
    }
    return faces;
}

bool holds_others(const Surface& surface, Face leaving)
{
    std::vector<char> left_out(surface.n_faces(), 0);
    left_out[leaving.idx()] = 1;
    return connected_regions(surface, std::move(left_out)).size() > 1;
}

//! Sides to unhook, and one more for each vertex of negative defect.
int effort(const Surface& surface, const Element& element, Face f)
{
    int sum = static_cast<int>(std::distance(surface.cff_begin(f), surface.cff_end(f)));
    for (const Vertex v : surface.fv_range(f)) {
        sum += !surface.is_boundary(v) && angular_defect(surface, element, v) < -1e-9;
    }
    return sum;
}

//! The one that keeps the shape least open when it waits for the end, every hole closed; -1: there is none.
int best_hatch(const PlanSources& sources, const std::vector<int>& elements)
{
    const Holes all = holes(sources.history);
    const std::vector<char> closed(all.count, 1);
    std::pair<long, int> best{std::numeric_limits<long>::max(), -1};
    for (const int e : elements) {
        const auto steps = greedy_order(sources, open_targets(sources.history, all, closed, e), {});
        best = std::min(best, {exposure(steps, sources.replay.surface), e});
    }
    return best.second;
}

} // namespace

bool names_hatch(std::string purpose)
{
    std::transform(purpose.begin(), purpose.end(), purpose.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return purpose.find("hatch") != std::string::npos;
}

std::vector<NamedOpening> named_openings(const Design& design, const Replay& replay)
{
    std::vector<NamedOpening> result;
    if (replay.stages.size() != design.operations.size()) {
        return result;
    }
    for (int stage = 1; stage < static_cast<int>(replay.stages.size()); ++stage) {
        const auto* open = std::get_if<Open>(&design.operations[stage]);
        if (open == nullptr || open->purpose.empty()) {
            continue;
        }
        const Surface& before = stage_surface(replay, stage - 1);
        for (const auto& hole : holes_made(before, stage_surface(replay, stage))) {
            NamedOpening opening{open->purpose, rim_of(hole, before, replay.surface), Vec3::Zero()};
            for (const int f : opening.beside) {
                opening.middle += element_centre(replay.surface, Face(f)) / static_cast<double>(opening.beside.size());
            }
            if (!opening.beside.empty()) {
                result.push_back(std::move(opening));
            }
        }
    }
    return result;
}

std::vector<int> hatch_elements(const Design& design, const Replay& replay, const Element& element)
{
    const auto found = std::find_if(design.operations.rbegin(), design.operations.rend(), is_hatch);
    const auto stage = static_cast<int>(design.operations.rend() - found) - 1;
    const Surface& surface = replay.surface;
    if (stage < 1 || replay.stages.size() != design.operations.size() || surface.n_faces() < 3) {
        return {};
    }
    const std::set<int> beside = beside_opening(replay, stage);
    std::vector<std::pair<int, int>> ranked;
    for (const Face f : surface.faces()) {
        if (beside.contains(surface.data(f).serial) && !holds_others(surface, f)) {
            ranked.emplace_back(effort(surface, element, f), f.idx());
        }
    }
    std::sort(ranked.begin(), ranked.end());
    std::vector<int> result;
    for (const auto& [joins, f] : ranked) {
        result.push_back(f);
    }
    return result;
}

AssemblyPlan design_plan(const Design& design, const Replay& replay, const Element& element, Order order)
{
    if (order == Order::Paper) {
        return assembly_plan(replay, element, order);
    }
    const BuildHistory history = build_history(replay, element);
    StageCoverage coverage(replay);
    PlanSources sources{replay, element, history, coverage};
    sources.last = best_hatch(sources, hatch_elements(design, replay, element));
    if (sources.last >= 0) {
        AssemblyPlan plan = best_plan(sources);
        if (!plan.steps.empty()) {
            return plan;
        }
    }
    sources.last = -1;
    return best_plan(sources);
}

} // namespace rhombloom
