#include "core/building/scorecard.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/building/viewpoints.h"
#include "core/model/angular_defect.h"

namespace rhombloom {

namespace {

//! Replays the steps of a plan on nothing but their joins.
struct Table
{
    std::vector<char> present;
    std::vector<Ports> hooked;
    int parts = 0;

    explicit Table(const AssemblyPlan& plan, std::size_t final_count)
        : present(final_count + plan.temporary.size(), 0), hooked(present.size())
    {
    }

    void apply(const Step& step)
    {
        const bool joining = step.kind == StepKind::Insert || step.kind == StepKind::Hook;
        for (const Join& join : step.joins) {
            hooked[step.element][join.side] = joining ? Port{join.to, join.to_side} : Port{};
            hooked[join.to][join.to_side] = joining ? Port{step.element, join.side} : Port{};
        }
        parts += step.kind == StepKind::Insert ? 1 : step.kind == StepKind::Remove ? -1 : 0;
        if (step.kind == StepKind::Insert || step.kind == StepKind::Remove) {
            present[step.element] = step.kind == StepKind::Insert;
        }
    }

    int pieces() const
    {
        int count = 0;
        std::vector<char> seen(present.size(), 0);
        for (std::size_t first = 0; first < present.size(); ++first) {
            if (!present[first] || seen[first]) {
                continue;
            }
            ++count;
            std::vector<int> open = {static_cast<int>(first)};
            seen[first] = 1;
            while (!open.empty()) {
                const int e = open.back();
                open.pop_back();
                for (const Port& port : hooked[e]) {
                    if (port.element >= 0 && !seen[port.element]) {
                        seen[port.element] = 1;
                        open.push_back(port.element);
                    }
                }
            }
        }
        return count;
    }
};

//! Minutes of a step. Anchored to the paper's pace, 0.78 to 1.26 minutes an element (Table 1), two joins on average.
double minutes(const Step& step, bool hard)
{
    const auto joins = static_cast<double>(step.joins.size());
    if (step.kind != StepKind::Insert) {
        return 0.15 + 0.1 * joins;
    }
    return 0.35 + 0.25 * joins + (joins == 1 ? 0.1 : 0) + (joins == 4 ? 0.4 : 0) + (hard ? 0.2 : 0);
}

//! \brief By stage: does a face touch a vertex of negative defect, all of whose elements the plan builds at some time?
//! \details Where an element is never built, the vertex lies on an open rim and is easy.
class Hardness
{
public:
    Hardness(const Replay& replay, const Element& element, const AssemblyPlan& plan)
        : replay_(replay), element_(element), plan_(plan)
    {
    }

    bool operator()(const Step& step)
    {
        if (step.stage != stage_) {
            stage_ = step.stage;
            face_ = faces_of_elements(replay_, plan_, stage_);
            shown_.assign(stage_surface(replay_, stage_).n_faces(), stage_ == last_stage(replay_));
            for (const int f : face_) {
                if (f >= 0) {
                    shown_[f] = 1;
                }
            }
        }
        const Surface& surface = stage_surface(replay_, stage_);
        if (face_[step.element] < 0) {
            return false;
        }
        const Face f(face_[step.element]);
        return std::any_of(surface.cfv_begin(f), surface.cfv_end(f), [&](Vertex v) {
            return !surface.is_boundary(v) && angular_defect(surface, element_, v) < -1e-9 && all_shown(surface, v);
        });
    }

private:
    bool all_shown(const Surface& surface, Vertex v) const
    {
        return std::all_of(surface.cvf_begin(v), surface.cvf_end(v), [&](Face f) { return shown_[f.idx()] != 0; });
    }

    const Replay& replay_;
    const Element& element_;
    const AssemblyPlan& plan_;
    int stage_ = -1;
    std::vector<int> face_;
    std::vector<char> shown_;
};

void count_insert(const Step& step, bool hard, Scorecard& score)
{
    ++score.inserts;
    score.one_neighbour_inserts += step.joins.size() == 1;
    score.four_at_once_inserts += step.joins.size() == 4;
    score.negative_defect_inserts += step.joins.size() >= 3 && hard;
}

} // namespace

long exposure(const std::vector<Step>& steps, const Surface& last)
{
    const auto waits = [&](int element, int side) {
        return element >= static_cast<int>(last.n_faces()) ||
               !last.is_boundary(last.opposite_halfedge_handle(side_halfedge(last, Face(element), side)));
    };
    long sum = 0;
    long waiting = 0;
    for (const Step& step : steps) {
        long hooked = 0;
        for (const Join& join : step.joins) {
            hooked += waits(step.element, join.side) + waits(join.to, join.to_side);
        }
        long own = 0;
        for (int side = 0; side < 4; ++side) {
            own += waits(step.element, side);
        }
        waiting += step.kind == StepKind::Insert   ? own - hooked
                   : step.kind == StepKind::Remove ? hooked - own
                   : step.kind == StepKind::Hook   ? -hooked
                                                   : hooked;
        sum += waiting;
    }
    return sum;
}

Scorecard scorecard(const Replay& replay, const Element& element, const AssemblyPlan& plan)
{
    StageCoverage coverage(replay);
    return scorecard(replay, element, plan, coverage);
}

Scorecard scorecard(const Replay& replay, const Element& element, const AssemblyPlan& plan, StageCoverage& coverage)
{
    Scorecard score;
    Table table(plan, replay.surface.n_faces());
    Hardness hardness(replay, element, plan);
    for (const Step& step : plan.steps) {
        const bool hard = hardness(step);
        table.apply(step);
        score.parts_needed = std::max(score.parts_needed, table.parts);
        score.removals += step.kind == StepKind::Remove;
        score.minutes += minutes(step, hard);
        if (step.kind == StepKind::Insert) {
            count_insert(step, hard, score);
        }
    }
    score.steps = static_cast<int>(plan.steps.size());
    score.exposure = exposure(plan.steps, replay.surface);
    score.view_turns = count_turns(held_views(replay, plan, coverage));
    return score;
}

namespace {

std::string at(std::size_t k)
{
    return "step " + std::to_string(k + 1) + ": ";
}

//! The elements that a chapter inserts from step \p k on.
std::vector<char> rest_of_chapter(const AssemblyPlan& plan, std::size_t k, std::size_t elements)
{
    std::vector<char> rest(elements, 0);
    const Step& first = plan.steps[k];
    for (; k < plan.steps.size(); ++k) {
        const Step& step = plan.steps[k];
        if (step.kind == StepKind::Insert) {
            if (step.stage != first.stage || step.component != first.component) {
                break;
            }
            rest[step.element] = 1;
        }
    }
    return rest;
}

//! Did the hole that the chapter found round the step's element hold one at no vertex of negative defect, which could
//! have been the plug instead?
bool has_easier_plug(const Replay& replay, const AssemblyPlan& plan, const Step& step, const std::vector<char>& rest,
                     Hardness& hardness)
{
    const Surface& surface = stage_surface(replay, step.stage);
    const std::vector<int> face = faces_of_elements(replay, plan, step.stage);
    std::vector<int> element(surface.n_faces(), -1);
    for (std::size_t e = 0; e < face.size(); ++e) {
        if (face[e] >= 0 && rest[e]) {
            element[face[e]] = static_cast<int>(e);
        }
    }
    std::vector<Face> open = {Face(face[step.element])};
    element[face[step.element]] = -1;
    while (!open.empty()) {
        const Face f = open.back();
        open.pop_back();
        for (const Face g : surface.ff_range(f)) {
            const int e = std::exchange(element[g.idx()], -1);
            if (e >= 0 && !hardness({StepKind::Insert, e, {}, step.component, step.stage})) {
                return true;
            }
            if (e >= 0) {
                open.push_back(g);
            }
        }
    }
    return false;
}

std::string insert_problem(const Step& step, const Table& table, bool hard_plug)
{
    if (table.present[step.element]) {
        return "H4: element " + std::to_string(step.element) + " is there already";
    }
    if (step.joins.empty() && table.parts > 0) {
        return "H1: element " + std::to_string(step.element) + " touches nothing";
    }
    if (hard_plug) {
        return "H6: element " + std::to_string(step.element) + " is plugged in at a vertex of negative defect";
    }
    return {};
}

bool consistent(const Step& step, const Table& table)
{
    const bool joining = step.kind == StepKind::Insert || step.kind == StepKind::Hook;
    const Ports& sides = table.hooked[step.element];
    const auto hooked = std::count_if(sides.begin(), sides.end(), [](const Port& p) { return p.element >= 0; });
    if (step.kind == StepKind::Remove && hooked != static_cast<long>(step.joins.size())) {
        return false; // a side would stay hooked to nothing
    }
    return std::all_of(step.joins.begin(), step.joins.end(), [&](const Join& join) {
        const Port there = table.hooked[join.to][join.to_side];
        return table.present[join.to] && there == (joining ? Port{} : Port{step.element, join.side});
    });
}

std::string end_problem(const Replay& replay, const Table& table)
{
    const Surface& surface = replay.surface;
    for (const Face f : surface.faces()) {
        for (int k = 0; k < 4; ++k) {
            const Halfedge back = surface.opposite_halfedge_handle(side_halfedge(surface, f, k));
            const Port want =
                surface.is_boundary(back) ? Port{} : Port{surface.face_handle(back).idx(), side_index(surface, back)};
            if (!table.present[f.idx()] || !(table.hooked[f.idx()][k] == want)) {
                return "H3/H7: side " + std::to_string(k) + " of element " + std::to_string(f.idx()) +
                       " does not end as in the final surface";
            }
        }
    }
    const auto left = static_cast<int>(surface.n_faces());
    return table.parts == left ? std::string() : "H3: temporary elements are left in the final surface";
}

} // namespace

std::vector<std::string> plan_problems(const Replay& replay, const Element& element, const AssemblyPlan& plan)
{
    std::vector<std::string> problems;
    Table table(plan, replay.surface.n_faces());
    Hardness hardness(replay, element, plan);
    std::set<std::pair<int, int>> chapters;
    std::pair<int, int> chapter{-1, -1};
    std::vector<char> rest;
    for (std::size_t k = 0; k < plan.steps.size(); ++k) {
        const Step& step = plan.steps[k];
        std::string problem;
        if (step.kind == StepKind::Insert) {
            const std::pair<int, int> now{step.stage, step.component};
            rest = now == chapter ? std::move(rest) : rest_of_chapter(plan, k, table.present.size());
            problem = insert_problem(step, table,
                                     step.joins.size() == 4 && hardness(step) &&
                                         has_easier_plug(replay, plan, step, rest, hardness));
            if (now != chapter && !chapters.insert(now).second) {
                problem = "H5: component " + std::to_string(step.component) + " is taken up again";
            }
            chapter = now;
        } else if (!table.present[step.element]) {
            problem = "H4: element " + std::to_string(step.element) + " is not there";
        }
        if (!consistent(step, table)) {
            problem = "the joins do not fit what is built";
        }
        table.apply(step);
        if (problem.empty() && table.pieces() > 1) {
            problem = "H2: the shape falls apart";
        }
        if (!problem.empty()) {
            problems.push_back(at(k) + problem);
        }
    }
    if (const std::string problem = end_problem(replay, table); !problem.empty()) {
        problems.push_back(problem);
    }
    return problems;
}

} // namespace rhombloom
