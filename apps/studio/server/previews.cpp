#include "apps/studio/server/previews.h"

#include <chrono>
#include <ctime>

#include "apps/studio/server/answers.h"
#include "apps/studio/server/geometry.h"
#include "apps/studio/server/motion.h"
#include "apps/studio/session/limits.h"
#include "core/design/operation_file.h"

namespace rhombloom::studio {

using nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

namespace {

constexpr double frame_budget_s = 0.008; // of embedding per frame of a drag
constexpr std::size_t most_pulls = 4;    // drags remembered: one per tab, and some that were left

double milliseconds_since(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

//! What this thread has computed since it began, without the time it had to wait for its turn.
double thread_milliseconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

//! The scene's surfaces with one part shown differently and maybe another left out.
std::vector<const Surface*> with_part(const Scene& scene, const std::string& id, const Surface& surface,
                                      const std::string& without = "")
{
    std::vector<const Surface*> result;
    for (const ScenePart& part : scene.parts) {
        if (part.id == id) {
            result.push_back(&surface);
        } else if (part.id != without) {
            result.push_back(&part.surface);
        }
    }
    return result;
}

std::vector<const Surface*> all_parts(const Scene& scene)
{
    std::vector<const Surface*> result;
    for (const ScenePart& part : scene.parts) {
        result.push_back(&part.surface);
    }
    return result;
}

//! What all previews have in common.
struct Asked
{
    nlohmann::json json;
    SnapshotPointer snapshot;
};

Expected<Asked> read(const Session& session, const Request& request)
{
    auto json = read_body(request);
    if (!json) {
        return tl::make_unexpected(json.error());
    }
    return Asked{std::move(*json), session.snapshot()};
}

long take_revision(ObjectReader& body)
{
    body.require("revision");
    return body.integer("revision", 0, 0, 2'000'000'000);
}

Reply stale(const Snapshot& snapshot)
{
    return json_reply({{"error", "the document has changed in the meantime"}, {"revision", snapshot.revision}}, 409);
}

bool same(const PullStart& a, const PullStart& b)
{
    return a.on == b.on && a.vertex == b.vertex && a.brush == b.brush && a.symmetric == b.symmetric;
}

Expected<MergeQuestion> take_question(ObjectReader& body, const Snapshot& snapshot)
{
    MergeQuestion question{snapshot.scene, snapshot.design.element, snapshot.design.symmetry, "", "", {}};
    body.require("on");
    body.require("with");
    question.on = body.text("on", "");
    question.with = body.text("with", "");
    const auto motion = take_motion(body);
    if (!motion) {
        return tl::make_unexpected(motion.error());
    }
    question.motion = *motion;
    return question;
}

ordered_json candidates_json(const MergeAnswer& answer)
{
    ordered_json result = ordered_json::array();
    for (std::size_t k = 0; k < answer.candidates.size(); ++k) {
        const MergeCandidate& c = answer.candidates[k];
        result.push_back({{"max_stretch", answer.stretches[k]},
                          {"removed", c.removed_a + c.removed_b},
                          {"seam", c.loop_size},
                          {"min_defect_deg", degrees(c.min_defect)},
                          {"max_defect_deg", degrees(c.max_defect)},
                          {"distance_mm", c.distance}});
    }
    return result;
}

} // namespace

std::shared_ptr<Previews::RunningPull> Previews::running_pull(int number)
{
    const std::scoped_lock lock(mutex_);
    for (auto it = pulls_.begin(); it != pulls_.end(); ++it) {
        if (it->first == number) {
            pulls_.splice(pulls_.begin(), pulls_, it);
            return pulls_.front().second;
        }
    }
    pulls_.emplace_front(number, std::make_shared<RunningPull>());
    if (pulls_.size() > most_pulls) {
        pulls_.pop_back();
    }
    return pulls_.front().second;
}

Reply Previews::pull(const Session& session, const Request& request)
{
    const auto began = Clock::now();
    const double began_cpu = thread_milliseconds();
    const auto asked = read(session, request);
    if (!asked) {
        return error_reply(asked.error());
    }
    ObjectReader body(asked->json, "$");
    const long revision = take_revision(body);
    for (const char* key : {"pull", "on", "vertex", "brush", "by_mm"}) {
        body.require(key);
    }
    const int number = body.integer("pull", 0, 0, 2'000'000'000);
    const PullStart start{body.text("on", ""), body.integer("vertex", 0, 0, 100'000'000), body.text("brush", ""),
                          body.flag("symmetric", false)};
    const Vec3 by = body.point("by_mm", Vec3::Zero());
    if (auto ok = body.finish(); !ok) {
        return error_reply(ok.error());
    }
    if (revision != asked->snapshot->revision) {
        return stale(*asked->snapshot);
    }
    const auto running = running_pull(number);
    const std::scoped_lock lock(running->mutex);
    if (running->revision != revision || !same(running->start, start)) {
        auto begun = Pull::begin(asked->snapshot->scene, asked->snapshot->design, start);
        running->revision = revision;
        running->start = start;
        running->reason = begun ? "" : begun.error().message;
        begun ? void(running->pull.emplace(std::move(*begun))) : running->pull.reset();
    }
    if (!running->pull) {
        return error_reply(422, running->reason);
    }
    const PullFrame frame = running->pull->drag(by, frame_budget_s);
    const Snapshot& snapshot = *asked->snapshot;
    const ordered_json header = {{"revision", revision},
                                 {"periods", frame.periods},
                                 {"settled", frame.settled},
                                 {"reason", frame.reason},
                                 {"work_ms", milliseconds_since(began)},
                                 {"cpu_ms", thread_milliseconds() - began_cpu}};
    return binary_reply(
        geometry_bytes(with_part(*snapshot.scene, start.on, *frame.surface), snapshot.design.element, header));
}

Reply Previews::merge(const Session& session, const Request& request)
{
    const auto asked = read(session, request);
    if (!asked) {
        return error_reply(asked.error());
    }
    ObjectReader body(asked->json, "$");
    const long revision = take_revision(body);
    const auto question = take_question(body, *asked->snapshot);
    const int candidate = body.integer("candidate", 0, 0, 1000);
    if (auto ok = body.finish(); !ok || !question) {
        return error_reply(ok ? question.error() : ok.error());
    }
    if (revision != asked->snapshot->revision) {
        return stale(*asked->snapshot);
    }
    const MergeAnswer answer = merge_.answer(*question, candidate);
    if (answer.surface == nullptr) {
        return json_reply({{"error", answer.reason}, {"candidates", candidates_json(answer)}}, 422);
    }
    const ordered_json header = {
        {"revision", revision}, {"candidates", candidates_json(answer)}, {"complete", answer.complete}};
    return binary_reply(geometry_bytes(with_part(*question->scene, question->on, *answer.surface, question->with),
                                       question->element, header));
}

Reply Previews::hint(const Session& session, const Request& request)
{
    const auto asked = read(session, request);
    if (!asked) {
        return error_reply(asked.error());
    }
    ObjectReader body(asked->json, "$");
    const long revision = take_revision(body);
    const auto question = take_question(body, *asked->snapshot);
    if (auto ok = body.finish(); !ok || !question) {
        return error_reply(ok ? question.error() : ok.error());
    }
    if (revision != asked->snapshot->revision) {
        return stale(*asked->snapshot);
    }
    constexpr double patience_s = 2.5;
    const auto hint = merge_hint(*question, patience_s);
    if (!hint) {
        return json_reply({{"kind", "none"}});
    }
    const Eigen::Quaterniond turn(hint->motion.linear());
    const Vec3 move = hint->motion.translation();
    return json_reply({{"kind", hint->kind},
                       {"amount", hint->amount},
                       {"move_mm", {move.x(), move.y(), move.z()}},
                       {"turn", {turn.x(), turn.y(), turn.z(), turn.w()}}});
}

Reply Previews::try_operation(const Session& session, const Request& request)
{
    const auto asked = read(session, request);
    if (!asked) {
        return error_reply(asked.error());
    }
    ObjectReader body(asked->json, "$");
    const long revision = take_revision(body);
    body.require("operation");
    const nlohmann::json* value = body.take("operation");
    const bool alone = body.flag("alone", false);
    const auto operation = read_operation(value == nullptr ? nlohmann::json() : *value, "$.operation");
    if (auto ok = body.finish(); !ok || !operation) {
        return error_reply(ok ? operation.error() : ok.error());
    }
    const Snapshot& snapshot = *asked->snapshot;
    if (revision != snapshot.revision) {
        return stale(snapshot);
    }
    if (auto fits = check_size(*operation, snapshot.design.element); !fits) {
        return error_reply(fits.error());
    }
    Scene scene = alone ? Scene{} : *snapshot.scene;
    if (auto done = carry_out(*operation, snapshot.design, {}, scene); !done) {
        return error_reply(done.error());
    }
    return binary_reply(geometry_bytes(all_parts(scene), snapshot.design.element, {{"revision", revision}}));
}

} // namespace rhombloom::studio
