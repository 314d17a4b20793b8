#include "apps/studio/session/session.h"

#include <filesystem>

#include "core/design/design_file.h"
#include "core/design/json_reader.h"
#include "exporters/save.h"

namespace rhombloom::studio {

namespace {

constexpr std::size_t max_bytes = 64'000'000;

std::string sentence(const Misfit& misfit, const Design& design)
{
    return "step " + std::to_string(misfit.operation + 1) + " (" + describe(design.operations[misfit.operation]) +
           "): " + misfit.reason;
}

//! Nothing where there is no file to be read.
std::optional<std::string> present_bytes(const std::string& path)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return std::nullopt;
    }
    auto bytes = load_file(path, max_bytes);
    return bytes ? std::optional(std::move(*bytes)) : std::nullopt;
}

} // namespace

Expected<Design> parse_document(const std::string& text)
{
    auto json = parse_json(text);
    if (!json || !json->is_object() || !json->contains("operations") ||
        (*json)["operations"] != nlohmann::json::array()) {
        return parse_design(text);
    }
    // A design has operations; a document may still be empty. Everything else about it is checked as usual.
    (*json)["operations"].push_back({{"op", "place"}, {"shape", "ball-30"}});
    auto design = parse_design(json->dump());
    if (design) {
        design->operations.clear();
    }
    return design;
}

Session::Session(std::string path, const Design& design) : path_(std::move(path))
{
    Design version = design;
    version.operations.clear();
    past_.push_back(std::make_shared<Design>(version));
    for (const Operation& operation : design.operations) {
        version.operations.push_back(operation);
        past_.push_back(std::make_shared<Design>(version));
    }
    cursor_ = past_.size() - 1;
}

Expected<std::unique_ptr<Session>> Session::open(const std::string& path)
{
    Design design;
    std::optional<std::string> written;
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) {
        auto bytes = load_file(path, max_bytes);
        if (!bytes) {
            return tl::make_unexpected(bytes.error());
        }
        auto read = parse_document(*bytes);
        if (!read) {
            return refuse(path + ": " + read.error().message);
        }
        design = std::move(*read);
        written = std::move(*bytes);
    } else if (const auto folder = std::filesystem::path(path).parent_path();
               !folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
        return refuse("there is no folder " + folder.string() + " for the design: make it first");
    }
    std::unique_ptr<Session> session(new Session(path, design));
    session->written_ = std::move(written);
    const auto scene = session->cache_.scene(design);
    if (!scene) {
        return refuse(path + ": " + sentence(scene.error(), design));
    }
    session->snapshot_ = std::make_shared<Snapshot>(Snapshot{1, design, *scene, session->cursor_ > 0, false});
    return session;
}

SnapshotPointer Session::snapshot() const
{
    const std::scoped_lock lock(mutex_);
    return snapshot_;
}

Outcome Session::refused(const std::string& message, int operation) const
{
    return {Outcome::Status::Refused, message, operation, snapshot()};
}

void Session::publish(std::vector<DesignPointer> past, std::size_t cursor, ScenePointer scene)
{
    auto next = std::make_shared<Snapshot>(
        Snapshot{snapshot()->revision + 1, *past[cursor], std::move(scene), cursor > 0, cursor + 1 < past.size()});
    past_ = std::move(past);
    cursor_ = cursor;
    const std::scoped_lock lock(mutex_);
    snapshot_ = std::move(next);
}

//! Carry out, save, then show; the order is what makes a killed program lose nothing.
Outcome Session::show(std::vector<DesignPointer> past, std::size_t cursor)
{
    const Design& design = *past[cursor];
    const auto scene = cache_.scene(design);
    if (!scene) {
        return refused(sentence(scene.error(), design), scene.error().operation);
    }
    std::string bytes = write_design(design);
    if (auto saved = save_file(path_, bytes); !saved) {
        return {Outcome::Status::Failed,
                saved.error().message + ": the step was not taken; mend that and try again, or use Save a copy", -1,
                snapshot()};
    }
    written_ = std::move(bytes);
    publish(std::move(past), cursor, *scene);
    return {Outcome::Status::Done, "", -1, snapshot()};
}

//! The present version and the ones before it, with \p design after them.
std::vector<Session::DesignPointer> Session::followed_by(Design design) const
{
    std::vector<DesignPointer> past(past_.begin(), past_.begin() + static_cast<std::ptrdiff_t>(cursor_) + 1);
    past.push_back(std::make_shared<Design>(std::move(design)));
    return past;
}

//! What another program has written into the file becomes the present version; undo brings back the one before it.
std::optional<Outcome> Session::take_foreign()
{
    auto found = present_bytes(path_);
    if (!found || found == written_) {
        return std::nullopt; // a file that is gone is written anew
    }
    auto design = parse_document(*found);
    const auto scene = design ? cache_.scene(*design) : tl::make_unexpected(Misfit{0, design.error().message});
    if (!scene) {
        const std::string reason = design ? sentence(scene.error(), *design) : scene.error().reason;
        return Outcome{Outcome::Status::Failed,
                       path_ + " was changed by another program and cannot be used (" + reason +
                           "): nothing was written; move it away to go on here",
                       -1, snapshot()};
    }
    written_ = std::move(found);
    if (write_design(*design) == write_design(*past_[cursor_])) {
        return std::nullopt; // only its spaces differ
    }
    auto past = followed_by(std::move(*design));
    const std::size_t last = past.size() - 1;
    publish(std::move(past), last, *scene);
    return Outcome{Outcome::Status::Stale, "the file was changed by another program", -1, snapshot()};
}

//! Why no change can be made on this revision now.
std::optional<Outcome> Session::obstacle(long revision)
{
    if (revision != snapshot()->revision) {
        return Outcome{Outcome::Status::Stale, "the document has changed in the meantime", -1, snapshot()};
    }
    return take_foreign();
}

Outcome Session::change(long revision, const Change& change)
{
    const std::scoped_lock lock(changing_);
    if (auto outcome = obstacle(revision)) {
        return *outcome;
    }
    auto changed = change(*past_[cursor_]);
    if (!changed) {
        return refused(changed.error().message);
    }
    // What is kept must be readable again: the limits of the file are the limits of the document.
    if (auto again = parse_document(write_design(*changed)); !again) {
        return refused(again.error().message);
    }
    auto past = followed_by(std::move(*changed));
    const std::size_t last = past.size() - 1;
    return show(std::move(past), last);
}

Outcome Session::apply(long revision, const Operation& operation)
{
    return change(revision, [&](Design design) -> Expected<Design> {
        design.operations.push_back(operation);
        return design;
    });
}

Outcome Session::edit(long revision, int index, const Operation& operation)
{
    return change(revision, [&](Design design) -> Expected<Design> {
        if (index < 0 || index >= static_cast<int>(design.operations.size())) {
            return refuse("there is no step " + std::to_string(index + 1));
        }
        design.operations[index] = operation;
        return design;
    });
}

Outcome Session::remove(long revision, int index)
{
    return change(revision, [&](Design design) -> Expected<Design> {
        if (index < 0 || index >= static_cast<int>(design.operations.size())) {
            return refuse("there is no step " + std::to_string(index + 1));
        }
        design.operations.erase(design.operations.begin() + index);
        return design;
    });
}

Outcome Session::replace(long revision, const Design& design)
{
    return change(revision, [&](const Design&) -> Expected<Design> { return design; });
}

Outcome Session::undo(long revision)
{
    const std::scoped_lock lock(changing_);
    if (auto outcome = obstacle(revision)) {
        return *outcome;
    }
    return cursor_ == 0 ? refused("there is nothing to undo") : show(past_, cursor_ - 1);
}

Outcome Session::redo(long revision)
{
    const std::scoped_lock lock(changing_);
    if (auto outcome = obstacle(revision)) {
        return *outcome;
    }
    return cursor_ + 1 >= past_.size() ? refused("there is nothing to do again") : show(past_, cursor_ + 1);
}

} // namespace rhombloom::studio
