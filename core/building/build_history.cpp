#include "core/building/build_history.h"

#include <algorithm>
#include <map>

#include "core/model/angular_defect.h"
#include "core/model/regions.h"

namespace rhombloom {

namespace {

using FacesBySerial = std::map<int, Face>;

FacesBySerial faces_by_serial(const Surface& surface)
{
    FacesBySerial faces;
    for (const Face f : surface.faces()) {
        const int serial = surface.data(f).serial;
        expects(serial >= 0, "assembly plan: every element has a serial");
        expects(faces.emplace(serial, f).second, "assembly plan: serials are unique in a stage");
    }
    return faces;
}

//! Faces of the part that shares most elements with \p built (the first part when it shares none), ascending.
std::vector<Face> continued_part(const Surface& surface, const std::vector<int>& built)
{
    std::vector<Face> faces;
    long most = -1;
    for (std::vector<Face>& part : connected_regions(surface)) {
        const long shared = std::count_if(part.begin(), part.end(), [&](Face f) {
            return std::binary_search(built.begin(), built.end(), surface.data(f).serial);
        });
        if (shared > most) {
            most = shared;
            faces = std::move(part);
        }
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

std::vector<int> serials(const Surface& surface, const std::vector<Face>& faces)
{
    std::vector<int> result;
    for (const Face f : faces) {
        result.push_back(surface.data(f).serial);
    }
    std::sort(result.begin(), result.end());
    return result;
}

struct Part
{
    int stage = 0;
    std::vector<Face> faces;
};

std::vector<Part> connected_parts(const Replay& replay)
{
    std::vector<Part> result;
    std::vector<int> built;
    for (int stage = 0; stage <= last_stage(replay); ++stage) {
        const Surface& surface = stage_surface(replay, stage);
        Part part{stage, continued_part(surface, built)};
        if (stage == last_stage(replay)) {
            const auto all = surface.faces();
            part.faces.assign(all.begin(), all.end());
        }
        built = serials(surface, part.faces);
        result.push_back(std::move(part));
    }
    return result;
}

bool touches_negative_vertex(const Surface& surface, const Element& element, Face f)
{
    return std::any_of(surface.cfv_begin(f), surface.cfv_end(f), [&](Vertex v) {
        return !surface.is_boundary(v) && angular_defect(surface, element, v) < -1e-9;
    });
}

using Numbers = std::map<int, int>; // serial -> element

Target target(const Surface& surface, const Element& element, const Part& part, const Numbers& numbers)
{
    Target result;
    result.stage = part.stage;
    result.face.assign(numbers.size(), -1);
    result.ports.resize(numbers.size());
    result.hard.assign(numbers.size(), 0);
    const auto number = [&](Face f) { return numbers.at(surface.data(f).serial); };
    for (const Face f : part.faces) {
        const int e = number(f);
        result.face[e] = f.idx();
        result.hard[e] = touches_negative_vertex(surface, element, f);
        for (int k = 0; k < 4; ++k) {
            const Halfedge back = surface.opposite_halfedge_handle(side_halfedge(surface, f, k));
            if (!surface.is_boundary(back)) {
                result.ports[e][k] = {number(surface.face_handle(back)), side_index(surface, back)};
            }
        }
    }
    return result;
}

int final_component(const Surface& last, const Surface& surface, Face f)
{
    const std::string& name = surface.components[surface.data(f).component];
    const auto found = std::find(last.components.begin(), last.components.end(), name);
    return found == last.components.end() ? 0 : static_cast<int>(found - last.components.begin());
}

Numbers number_elements(const Replay& replay, const std::vector<Part>& all, BuildHistory& history)
{
    const Surface& last = stage_surface(replay, last_stage(replay));
    Numbers numbers;
    for (const auto& [serial, f] : faces_by_serial(last)) {
        numbers[serial] = f.idx();
    }
    history.final_count = static_cast<int>(last.n_faces());
    for (const Face f : last.faces()) {
        history.component.push_back(last.data(f).component);
    }
    for (const Part& part : all) {
        const Surface& surface = stage_surface(replay, part.stage);
        for (const Face f : part.faces) {
            const int next = static_cast<int>(numbers.size());
            if (numbers.emplace(surface.data(f).serial, next).second) {
                history.temporary.push_back({next, part.stage, f.idx()});
                history.component.push_back(final_component(last, surface, f));
            }
        }
    }
    return numbers;
}

} // namespace

int last_stage(const Replay& replay)
{
    return std::max(0, static_cast<int>(replay.stages.size()) - 1);
}

const Surface& stage_surface(const Replay& replay, int stage)
{
    return stage == last_stage(replay) ? replay.surface : replay.stages[stage].surface;
}

BuildHistory build_history(const Replay& replay, const Element& element)
{
    const std::vector<Part> all = connected_parts(replay);
    BuildHistory history;
    const Numbers numbers = number_elements(replay, all, history);
    for (const Part& part : all) {
        Target next = target(stage_surface(replay, part.stage), element, part, numbers);
        const bool same = !history.targets.empty() && history.targets.back().ports == next.ports &&
                          std::equal(next.face.begin(), next.face.end(), history.targets.back().face.begin(),
                                     [](int a, int b) { return (a < 0) == (b < 0); });
        if (same && part.stage != last_stage(replay)) {
            continue; // nothing to build: another part was placed, or the shape only moved
        }
        if (same) {
            history.targets.pop_back();
        }
        history.targets.push_back(std::move(next));
    }
    return history;
}

std::vector<int> faces_of_elements(const Replay& replay, const AssemblyPlan& plan, int stage)
{
    const Surface& last = stage_surface(replay, last_stage(replay));
    const FacesBySerial faces = faces_by_serial(stage_surface(replay, stage));
    const auto find = [&](int serial) {
        const auto found = faces.find(serial);
        return found == faces.end() ? -1 : found->second.idx();
    };
    std::vector<int> result;
    for (const Face f : last.faces()) {
        result.push_back(find(last.data(f).serial));
    }
    for (const TemporaryElement& t : plan.temporary) {
        result.push_back(find(stage_surface(replay, t.stage).data(Face(t.face)).serial));
    }
    return result;
}

std::vector<char> shown_elements(const AssemblyPlan& plan, std::size_t final_count, int stage)
{
    std::vector<char> present(final_count + plan.temporary.size(), 0);
    std::vector<char> shown(present.size(), 0);
    for (const Step& step : plan.steps) {
        present[step.element] = 1;
        if (step.stage == stage) {
            for (std::size_t e = 0; e < present.size(); ++e) {
                shown[e] |= present[e];
            }
        }
        present[step.element] = step.kind != StepKind::Remove;
    }
    return shown;
}

Target without(const Target& target, const std::vector<char>& left_out)
{
    Target result = target;
    for (std::size_t e = 0; e < left_out.size(); ++e) {
        if (left_out[e]) {
            result.face[e] = -1;
            result.ports[e] = {};
        }
        for (Port& port : result.ports[e]) {
            if (port.element >= 0 && left_out[port.element]) {
                port = {};
            }
        }
    }
    return result;
}

} // namespace rhombloom
