#include "apps/studio/server/answers.h"

#include <filesystem>

#include "apps/studio/session/edits.h"
#include "core/design/operation_file.h"
#include "core/model/angular_defect.h"
#include "core/model/validity.h"

namespace rhombloom::studio {

using nlohmann::ordered_json;

namespace {

bool movable(const Design& design, const std::string& id)
{
    return moved_part(design, id, Eigen::Isometry3d::Identity()).has_value();
}

ordered_json part_json(const ScenePart& part, const Design& design)
{
    int flipped = 0;
    for (const Face f : part.surface.faces()) {
        flipped += part.surface.data(f).facing == Facing::Back ? 1 : 0;
    }
    const Validity validity = validate(part.surface, design.element);
    const DefectRange defects = defect_range(part.surface, design.element);
    return {{"id", part.id},
            {"elements", part.surface.n_faces()},
            {"flipped", flipped},
            {"openings", validity.boundary_loops},
            {"problems", validity.problems},
            {"settled", part.embedding.converged},
            {"max_stretch", part.embedding.max_stretch},
            {"min_defect_deg", degrees(defects.min)},
            {"max_defect_deg", degrees(defects.max)},
            {"movable", movable(design, part.id)}};
}

} // namespace

Reply json_reply(const ordered_json& value, int status)
{
    return {status, "application/json", value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

Reply error_reply(int status, const std::string& message)
{
    return json_reply({{"error", message}}, status);
}

Reply error_reply(const Error& error)
{
    return error_reply(error.kind == Error::Kind::Input ? 422 : 500, error.message);
}

Reply binary_reply(std::string bytes)
{
    return {200, "application/octet-stream", std::move(bytes)};
}

ordered_json state_json(const Session& session, const Snapshot& snapshot)
{
    const Design& design = snapshot.design;
    ordered_json state = {{"revision", snapshot.revision},
                          {"file", std::filesystem::path(session.path()).filename().string()},
                          {"title", design.title},
                          {"element",
                           {{"la_mm", design.element.la},
                            {"lb_mm", design.element.lb},
                            {"alpha_deg", degrees(design.element.alpha)},
                            {"thickness_mm", design.element.thickness}}},
                          {"symmetry", nullptr},
                          {"can_undo", snapshot.can_undo},
                          {"can_redo", snapshot.can_redo},
                          {"operations", ordered_json::array()},
                          {"texts", ordered_json::array()},
                          {"parts", ordered_json::array()}};
    if (design.symmetry.kind != Symmetry::Kind::None) {
        state["symmetry"] = write_symmetry(design.symmetry);
    }
    for (const Operation& operation : design.operations) {
        state["operations"].push_back(write_operation(operation));
        state["texts"].push_back(describe(operation));
    }
    for (const ScenePart& part : snapshot.scene->parts) {
        state["parts"].push_back(part_json(part, design));
    }
    return state;
}

Reply outcome_reply(const Session& session, const Outcome& outcome)
{
    using Status = Outcome::Status;
    if (outcome.status == Status::Done) {
        return json_reply(state_json(session, *outcome.snapshot));
    }
    const int status = outcome.status == Status::Stale ? 409 : outcome.status == Status::Refused ? 422 : 500;
    ordered_json reply = {{"error", outcome.message}, {"revision", outcome.snapshot->revision}};
    if (outcome.operation >= 0) {
        reply["operation"] = outcome.operation;
    }
    return json_reply(reply, status);
}

Expected<nlohmann::json> read_body(const Request& request)
{
    auto body = parse_json(request.body);
    if (body && !body->is_object()) {
        return refuse("the request is " + describe(*body) + ": expected an object");
    }
    return body;
}

} // namespace rhombloom::studio
