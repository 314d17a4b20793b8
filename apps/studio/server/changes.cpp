#include "apps/studio/server/changes.h"

#include "apps/studio/server/answers.h"
#include "apps/studio/server/motion.h"
#include "apps/studio/session/edits.h"
#include "apps/studio/session/limits.h"
#include "core/design/operation_file.h"

namespace rhombloom::studio {

namespace {

using Body = ObjectReader;
using Handler = Outcome (*)(Session&, long, Body&);

constexpr int most_revisions = 2'000'000'000;
constexpr int most_operations = 10000;

Outcome refused(const Session& session, const std::string& message)
{
    return {Outcome::Status::Refused, message, -1, session.snapshot()};
}

Expected<Operation> take_operation(Body& body, const Element& element)
{
    body.require("operation");
    const nlohmann::json* value = body.take("operation");
    if (value == nullptr) {
        return tl::make_unexpected(body.finish().error());
    }
    auto operation = read_operation(*value, "$.operation");
    if (operation) {
        if (auto ok = check_size(*operation, element); !ok) {
            return tl::make_unexpected(ok.error());
        }
    }
    return operation;
}

Outcome apply(Session& session, long revision, Body& body)
{
    const auto operation = take_operation(body, session.snapshot()->design.element);
    const auto ok = body.finish();
    if (!operation || !ok) {
        return refused(session, operation ? ok.error().message : operation.error().message);
    }
    return session.apply(revision, *operation);
}

Outcome edit(Session& session, long revision, Body& body)
{
    const auto operation = take_operation(body, session.snapshot()->design.element);
    body.require("index");
    const int index = body.integer("index", 0, 0, most_operations);
    const auto ok = body.finish();
    if (!operation || !ok) {
        return refused(session, operation ? ok.error().message : operation.error().message);
    }
    return session.edit(revision, index, *operation);
}

Outcome remove(Session& session, long revision, Body& body)
{
    body.require("index");
    const int index = body.integer("index", 0, 0, most_operations);
    const auto ok = body.finish();
    return ok ? session.remove(revision, index) : refused(session, ok.error().message);
}

Outcome undo(Session& session, long revision, Body& body)
{
    const auto ok = body.finish();
    return ok ? session.undo(revision) : refused(session, ok.error().message);
}

Outcome redo(Session& session, long revision, Body& body)
{
    const auto ok = body.finish();
    return ok ? session.redo(revision) : refused(session, ok.error().message);
}

Outcome move(Session& session, long revision, Body& body)
{
    body.require("part");
    const std::string part = body.text("part", "");
    const auto motion = take_motion(body);
    const auto ok = body.finish();
    if (!motion || !ok) {
        return refused(session, ok ? motion.error().message : ok.error().message);
    }
    return session.change(revision, [&](const Design& design) { return moved_part(design, part, *motion); });
}

Outcome remove_part(Session& session, long revision, Body& body)
{
    body.require("part");
    const std::string part = body.text("part", "");
    const auto ok = body.finish();
    if (!ok) {
        return refused(session, ok.error().message);
    }
    return session.change(revision, [&](const Design& design) { return without_part(design, part); });
}

//! Title and symmetry: what belongs to no operation.
Outcome document(Session& session, long revision, Body& body)
{
    const Design present = session.snapshot()->design;
    const std::string title = body.text("title", present.title);
    Symmetry symmetry = present.symmetry;
    Expected<void> read_ok;
    if (const nlohmann::json* value = body.take("symmetry")) {
        const auto read = value->is_null() ? Expected<Symmetry>(Symmetry{}) : read_symmetry(*value, "$.symmetry");
        read ? void(symmetry = *read) : body.fail(read.error());
    }
    const auto ok = body.finish();
    if (!ok) {
        return refused(session, ok.error().message);
    }
    return session.change(revision, [&](Design design) -> Expected<Design> {
        design.title = title;
        design.symmetry = symmetry;
        return design;
    });
}

Outcome replace(Session& session, long revision, Body& body)
{
    body.require("design");
    const nlohmann::json* value = body.take("design");
    const auto design = parse_document(value == nullptr ? "" : value->dump());
    const auto ok = body.finish();
    if (!design || !ok) {
        return refused(session, ok ? design.error().message : ok.error().message);
    }
    for (const Operation& operation : design->operations) {
        if (auto fits = check_size(operation, design->element); !fits) {
            return refused(session, fits.error().message);
        }
    }
    return session.replace(revision, *design);
}

const std::map<std::string, Handler>& handlers()
{
    static const std::map<std::string, Handler> all = {
        {"/api/apply", apply},        {"/api/edit", edit},         {"/api/remove", remove},
        {"/api/undo", undo},          {"/api/redo", redo},         {"/api/move", move},
        {"/api/delete", remove_part}, {"/api/document", document}, {"/api/replace", replace}};
    return all;
}

} // namespace

bool changes_document(const std::string& path)
{
    return handlers().contains(path);
}

Reply change_document(Session& session, const Request& request)
{
    const auto json = read_body(request);
    if (!json) {
        return error_reply(json.error());
    }
    Body body(*json, "$");
    body.require("revision");
    const int revision = body.integer("revision", 0, 0, most_revisions);
    return outcome_reply(session, handlers().at(request.path)(session, revision, body));
}

} // namespace rhombloom::studio
