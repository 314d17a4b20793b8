#include "exporters/plan_file.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/building/scorecard.h"

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;

const char* name(StepKind kind)
{
    switch (kind) {
    case StepKind::Insert:
        return "insert";
    case StepKind::Remove:
        return "remove";
    case StepKind::Unhook:
        return "unhook";
    default:
        return "hook";
    }
}

double rounded(double value, double unit)
{
    return std::round(value / unit) * unit + 0.0;
}

Json joins(const Step& step)
{
    Json list = Json::array();
    for (const Join& join : step.joins) {
        list.push_back({{"to", join.to}, {"side", join.side}, {"to_side", join.to_side}});
    }
    return list;
}

Json matrix(const Matrix34& m)
{
    Json rows = Json::array();
    for (int r = 0; r < 3; ++r) {
        Json row = Json::array();
        for (int c = 0; c < 4; ++c) {
            row.push_back(rounded(m(r, c), c < 3 ? 1e-9 : 1e-6));
        }
        rows.push_back(row);
    }
    return rows;
}

Json scorecard_json(const Scorecard& s)
{
    return {{"steps", s.steps},
            {"inserts", s.inserts},
            {"removals", s.removals},
            {"parts_needed", s.parts_needed},
            {"exposure", s.exposure},
            {"one_neighbour_inserts", s.one_neighbour_inserts},
            {"four_at_once_inserts", s.four_at_once_inserts},
            {"negative_defect_inserts", s.negative_defect_inserts},
            {"view_turns", s.view_turns},
            {"minutes", rounded(s.minutes, 0.1)}};
}

//! The stages before the last that some step is drawn in.
std::vector<int> earlier_stages(const Replay& replay, const AssemblyPlan& plan)
{
    std::vector<int> stages;
    for (const Step& step : plan.steps) {
        if (step.stage != last_stage(replay) && (stages.empty() || stages.back() != step.stage)) {
            stages.push_back(step.stage);
        }
    }
    return stages;
}

Json shape(const Replay& replay, const AssemblyPlan& plan, int stage)
{
    const Surface& surface = stage_surface(replay, stage);
    Json vertices = Json::array();
    Json sides = Json::array();
    for (const Vertex v : surface.vertices()) {
        const Vec3& p = surface.point(v);
        vertices.push_back({rounded(p.x(), 1e-6), rounded(p.y(), 1e-6), rounded(p.z(), 1e-6)});
        sides.push_back(surface.data(v).side == Side::Long ? "long" : "short");
    }
    Json faces = Json::array();
    Json facing = Json::array();
    Json elements = Json::array();
    const std::vector<int> face = faces_of_elements(replay, plan, stage);
    for (int e = 0; e < static_cast<int>(face.size()); ++e) {
        if (face[e] >= 0) {
            const Face f(face[e]);
            faces.push_back(quad(surface, f));
            facing.push_back(surface.data(f).facing == Facing::Front ? "front" : "back");
            elements.push_back(e);
        }
    }
    return {{"vertices_mm", vertices},
            {"vertex_side", sides},
            {"faces", faces},
            {"facing", facing},
            {"elements", elements}};
}

Json temporary(const Replay& replay, const AssemblyPlan& plan)
{
    Json list = Json::array();
    for (const TemporaryElement& t : plan.temporary) {
        const Surface& surface = stage_surface(replay, t.stage);
        const Face f(t.face);
        const bool first_long = side(surface, side_halfedge(surface, f, 0)) == Side::Long;
        list.push_back({{"element", t.element},
                        {"facing", surface.data(f).facing == Facing::Front ? "front" : "back"},
                        {"first_side", first_long ? "long" : "short"}});
    }
    return list;
}

Json inset(const std::optional<Inset>& inset, double page_height)
{
    if (!inset) {
        return nullptr;
    }
    return {{"centre_pt", {rounded(inset->centre.x(), 1e-3), rounded(page_height - inset->centre.y(), 1e-3)}},
            {"radius_pt", rounded(inset->radius, 1e-3)},
            {"view", matrix(page_matrix(inset->camera, inset->centre, page_height))}};
}

Json turn(const Turn& t)
{
    return {{"round_deg", t.round}, {"tilt_deg", t.tilt}};
}

//! One line for each entry of the document, and for each member of its lists.
std::string lines(const Json& document)
{
    std::string text = "{";
    for (const auto& [key, value] : document.items()) {
        text += (text.size() > 1 ? ",\n" : "\n") + Json(key).dump() + ": ";
        if (!value.is_array() || value.empty() || value.front().is_number()) {
            text += value.dump();
            continue;
        }
        for (std::size_t i = 0; i < value.size(); ++i) {
            text += (i == 0 ? "[\n  " : ",\n  ") + value[i].dump();
        }
        text += "]";
    }
    return text + "}\n";
}

} // namespace

std::string plan_json(const Replay& replay, const Element&, const AssemblyPlan& plan, const BookletLayout& layout)
{
    const std::vector<int> stages = earlier_stages(replay, plan);
    Json document = {{"format", "rhombloom-plan"},
                     {"version", 1},
                     {"order", plan.order == Order::Paper ? "paper" : "best"},
                     {"paper_pt", {rounded(layout.paper.width, 1e-6), rounded(layout.paper.height, 1e-6)}},
                     {"steps", Json::array()},
                     {"temporary", temporary(replay, plan)},
                     {"shapes", Json::array()},
                     {"scorecard", scorecard_json(plan.scorecard)}};
    for (std::size_t k = 0; k < plan.steps.size(); ++k) {
        const Step& step = plan.steps[k];
        const StepPlace& place = layout.places[k];
        const auto found = std::find(stages.begin(), stages.end(), step.stage);
        document["steps"].push_back(
            {{"op", name(step.kind)},
             {"element", step.element},
             {"joins", joins(step)},
             {"component", replay.surface.components[step.component]},
             {"shape", found == stages.end() ? Json("final") : Json(found - stages.begin())},
             {"page", place.page},
             {"cell", place.cell},
             {"cell_pt",
              {rounded(place.box.min.x(), 1e-3), rounded(layout.paper.height - place.box.max.y(), 1e-3),
               rounded(place.box.max.x(), 1e-3), rounded(layout.paper.height - place.box.min.y(), 1e-3)}},
             {"view", matrix(page_matrix(place.camera, place.centre, layout.paper.height))},
             {"turn", turn(place.turn)},
             {"inset", inset(place.inset, layout.paper.height)}});
    }
    for (const int stage : stages) {
        document["shapes"].push_back(shape(replay, plan, stage));
    }
    return lines(document);
}

} // namespace rhombloom
