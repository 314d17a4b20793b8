#include "apps/studio/server/kit_job.h"

#include <filesystem>

#include "apps/studio/server/answers.h"
#include "apps/studio/server/guard.h"
#include "exporters/target_file.h"

namespace rhombloom::studio {

using nlohmann::ordered_json;

namespace {

std::string type_of(const std::string& name)
{
    static const std::map<std::string, std::string> types = {
        {".svg", "image/svg+xml"},     {".png", "image/png"},       {".pdf", "application/pdf"},
        {".html", "text/html"},        {".txt", "text/plain"},      {".json", "application/json"},
        {".glb", "model/gltf-binary"}, {".zip", "application/zip"}, {".scad", "text/plain"}};
    const std::size_t dot = name.rfind('.');
    const auto found = types.find(dot == std::string::npos ? "" : name.substr(dot));
    return found == types.end() ? "application/octet-stream" : found->second;
}

ordered_json figures(const Kit& kit)
{
    return {{"elements", kit.cut.elements},
            {"sheets", kit.cut.sheets},
            {"cut_length_m", kit.cut.cut_length_m},
            {"minutes", kit.cut.minutes},
            {"mass_g", kit.cut.mass_g},
            {"steps", kit.scorecard.steps},
            {"building_minutes", kit.scorecard.minutes},
            {"warnings", kit.warnings}};
}

} // namespace

KitJob::~KitJob()
{
    if (thread_.joinable()) {
        thread_.join();
    }
}

Expected<KitJob::Wish> KitJob::read(const Session& session, const Request& request) const
{
    const auto json = read_body(request);
    if (!json) {
        return tl::make_unexpected(json.error());
    }
    ObjectReader body(*json, "$");
    const SnapshotPointer snapshot = session.snapshot();
    Wish wish{snapshot->design,
              snapshot->revision,
              body.text("material", ""),
              {},
              body.number("kerf_mm", -1, -1, 1),
              std::filesystem::path(session.path()).parent_path().string()};
    const std::string machine = body.text("machine", "");
    const std::string paper = body.text("paper", "a4");
    body.require("revision");
    const int revision = body.integer("revision", 0, 0, 2'000'000'000);
    if (paper != "a4" && paper != "letter") {
        body.fail("paper", "is \"" + paper.substr(0, 20) + "\": expected a4 or letter");
    }
    wish.options.paper = paper == "letter" ? Paper::Letter : Paper::A4;
    if (!machine.empty()) {
        const auto found = find_machine(machine);
        found ? use_machine(wish.options.cut, *found) : body.fail(found.error());
    }
    if (auto ok = body.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    if (revision != snapshot->revision) {
        return refuse("the document has changed in the meantime");
    }
    return wish;
}

Reply KitJob::start(const Session& session, const Request& request)
{
    auto wish = read(session, request);
    if (!wish) {
        return error_reply(wish.error());
    }
    const std::scoped_lock lock(mutex_);
    if (running_) {
        return error_reply(409, "a kit is being made already");
    }
    if (thread_.joinable()) {
        thread_.join();
    }
    running_ = true;
    doing_ = "replay";
    error_.clear();
    thread_ = std::thread([this, made = std::move(*wish)] { work(made); });
    return json_reply({{"running", true}});
}

void KitJob::tell(const std::string& what)
{
    const std::scoped_lock lock(mutex_);
    doing_ = what;
}

Expected<Kit> KitJob::made(const Wish& wish)
{
    KitOptions options = wish.options;
    if (auto ok = check_names(wish.design, options); !ok) {
        return tl::make_unexpected(ok.error());
    }
    ReplayOptions replaying;
    replaying.progress = [&](int number, int count, const std::string& what) {
        tell(std::to_string(number + 1) + "/" + std::to_string(count) + " " + what);
        return true;
    };
    const auto replayed = replay(wish.design, replaying);
    if (!replayed) {
        return tl::make_unexpected(replayed.error());
    }
    const auto piece = make_piece(
        wish.design.element, wish.material.empty() ? std::nullopt : std::optional(wish.material),
        wish.kerf < 0 ? std::vector<ParameterSetting>{} : std::vector<ParameterSetting>{{"kerf", wish.kerf}});
    if (!piece) {
        return tl::make_unexpected(piece.error());
    }
    auto target = load_targets(wish.design, wish.folder);
    if (target) {
        options.target = std::move(*target);
    }
    options.program_version = version_;
    options.progress = [&](const std::string& what) { tell(what); };
    auto kit = make_kit(wish.design, *replayed, *piece, options);
    if (kit && !target) { // a design opened from elsewhere comes without it
        kit->warnings.push_back(target.error().message + ": the preview is without its target");
    }
    return kit;
}

void KitJob::work(const Wish& wish)
{
    Expected<Kit> kit = machine_failure("the kit could not be made");
    try {
        kit = made(wish);
    } catch (const std::exception& problem) {
        kit = machine_failure(std::string("a bug stopped the kit: ") + problem.what());
    }
    const std::scoped_lock lock(mutex_);
    running_ = false;
    doing_.clear();
    if (!kit) {
        error_ = kit.error().message;
        return;
    }
    id_ = random_token();
    revision_ = wish.revision;
    kit_ = std::make_shared<const Kit>(std::move(*kit));
}

Reply KitJob::state() const
{
    const std::scoped_lock lock(mutex_);
    ordered_json state = {{"running", running_}, {"doing", doing_}, {"error", error_}};
    if (kit_ != nullptr) {
        state["id"] = id_;
        state["revision"] = revision_;
        state["figures"] = figures(*kit_);
        state["files"] = ordered_json::array();
        for (const auto& [name, bytes] : kit_->files) {
            state["files"].push_back(name);
        }
    }
    return json_reply(state);
}

Reply KitJob::file(const std::string& path) const
{
    std::shared_ptr<const Kit> kit;
    std::string name;
    {
        const std::scoped_lock lock(mutex_);
        const std::string prefix = "/kit/" + id_ + "/";
        if (kit_ == nullptr || !path.starts_with(prefix)) {
            return error_reply(404, "there is no such kit");
        }
        kit = kit_;
        name = path.substr(prefix.size());
    }
    if (name == "kit.zip") {
        auto bytes = zip(kit->files, "kit");
        return bytes ? Reply{200,
                             "application/zip",
                             std::move(*bytes),
                             {{"Content-Disposition", "attachment; filename=\"kit.zip\""}}}
                     : error_reply(bytes.error());
    }
    const auto found = kit->files.find(name);
    if (found == kit->files.end()) {
        return error_reply(404, "the kit has no such file");
    }
    return {200, type_of(name), found->second};
}

} // namespace rhombloom::studio
