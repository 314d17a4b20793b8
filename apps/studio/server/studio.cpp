#include "apps/studio/server/studio.h"

#include "apps/studio/server/answers.h"
#include "apps/studio/server/changes.h"
#include "apps/studio/server/geometry.h"
#include "apps/studio/server/mesh_upload.h"
#include "core/design/design_file.h"

namespace rhombloom::studio {

using nlohmann::ordered_json;

namespace {

Reply geometry(const Snapshot& snapshot)
{
    std::vector<const Surface*> surfaces;
    for (const ScenePart& part : snapshot.scene->parts) {
        surfaces.push_back(&part.surface);
    }
    return binary_reply(geometry_bytes(surfaces, snapshot.design.element, {{"revision", snapshot.revision}}));
}

Reply design_file(const Snapshot& snapshot)
{
    return {200, "application/json", write_design(snapshot.design)};
}

} // namespace

Studio::Studio(std::unique_ptr<Session> session, Shelf shelf, std::string program_version)
    : session_(std::move(session)), shelf_(std::move(shelf)), kit_(std::move(program_version))
{
}

Reply Studio::layouts()
{
    const std::scoped_lock lock(shelf_mutex_);
    return json_reply({{"layouts", shelf_.layouts()}});
}

Reply Studio::keep_layouts(const Request& request)
{
    const auto json = read_body(request);
    if (!json) {
        return error_reply(json.error());
    }
    ObjectReader body(*json, "$");
    body.require("layouts");
    const nlohmann::json* list = body.take("layouts");
    if (auto ok = body.finish(); !ok) {
        return error_reply(ok.error());
    }
    const std::scoped_lock lock(shelf_mutex_);
    const auto kept = shelf_.keep(*list);
    return kept ? json_reply({{"kept", list->size()}}) : error_reply(kept.error());
}

Reply Studio::answer(const Request& request)
{
    const SnapshotPointer snapshot = session_->snapshot();
    const Element& element = snapshot->design.element;
    using Answer = std::function<Reply()>;
    const std::map<std::string, Answer> reads = {
        {"/api/state", [&] { return json_reply(state_json(*session_, *snapshot)); }},
        {"/api/revision",
         [&] {
             return json_reply({{"revision", snapshot->revision}});
         }},
        {"/api/geometry", [&] { return geometry(*snapshot); }},
        {"/api/design", [&] { return design_file(*snapshot); }},
        {"/api/shapes", [&] { return library_.shapes(element); }},
        {"/api/thumbnail", [&] { return library_.thumbnail(request, element); }},
        {"/api/piece", [&] { return library_.piece(element); }},
        {"/api/figures", [&] { return library_.figures(request, element); }},
        {"/api/choices", [&] { return library_.choices(); }},
        {"/api/layouts", [&] { return layouts(); }},
        {"/api/kit", [&] { return kit_.state(); }}};
    const std::map<std::string, Answer> posts = {
        {"/api/pull", [&] { return previews_.pull(*session_, request); }},
        {"/api/merge", [&] { return previews_.merge(*session_, request); }},
        {"/api/hint", [&] { return previews_.hint(*session_, request); }},
        {"/api/try", [&] { return previews_.try_operation(*session_, request); }},
        {"/api/layouts", [&] { return keep_layouts(request); }},
        {"/api/import", [&] { return import_upload(*session_, request); }},
        {"/api/fabricate", [&] { return kit_.start(*session_, request); }}};
    const bool post = request.method == "POST";
    if (post && changes_document(request.path)) {
        return change_document(*session_, request);
    }
    if (!post && request.path.starts_with("/kit/")) {
        return kit_.file(request.path);
    }
    const auto& answers = post ? posts : reads;
    const auto found = answers.find(request.path);
    if (found != answers.end()) {
        return found->second();
    }
    const bool other_method = (post ? reads : posts).contains(request.path) || changes_document(request.path);
    return other_method ? error_reply(405, "wrong method") : error_reply(404, "there is nothing at this address");
}

Reply Studio::handle(const Request& request)
{
    try {
        return answer(request);
    } catch (const std::bad_alloc&) {
        return error_reply(500, "out of memory: try a smaller design");
    } catch (const std::exception& problem) {
        return error_reply(500, std::string("a bug stopped this request: ") + problem.what());
    }
}

} // namespace rhombloom::studio
