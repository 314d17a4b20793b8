#include "core/design/history.h"

#include "core/design/scene.h"

namespace rhombloom {

namespace {

std::string path(std::size_t operation)
{
    return "$.operations[" + std::to_string(operation) + "]";
}

Expected<void> check_joined(const Scene& scene)
{
    if (scene.parts.size() == 1) {
        return {};
    }
    std::string names;
    for (const ScenePart& part : scene.parts) {
        names += (names.empty() ? "" : ", ") + part.id;
    }
    return refuse("$.operations: at the end the parts " + names +
                  " are still separate: merge them or make them separate designs");
}

} // namespace

Expected<Replay> replay(const Design& design, const ReplayOptions& options)
{
    if (design.operations.empty()) {
        return refuse("$.operations is empty: a design starts with place or layout");
    }
    Replay result;
    Scene scene;
    const int count = static_cast<int>(design.operations.size());
    for (int i = 0; i < count; ++i) {
        const std::string text = describe(design.operations[i]);
        if (options.progress && !options.progress(i, count, text)) {
            return refuse("stopped");
        }
        if (auto done = carry_out(design.operations[i], design, options.embedding, scene); !done) {
            return refuse(path(i) + ": " + done.error().message);
        }
        auto surface = whole(scene);
        if (!surface) {
            return refuse(path(i) + ": " + surface.error().message);
        }
        result.stages.push_back({text, std::move(*surface)});
    }
    if (auto ok = check_joined(scene); !ok) {
        return tl::make_unexpected(ok.error());
    }
    result.surface = result.stages.back().surface;
    result.embedding = scene.parts.front().embedding;
    return result;
}

History::History(Design design) : all_(std::move(design)), cursor_(size()) {}

Design History::design() const
{
    Design done = all_;
    done.operations.resize(cursor_);
    return done;
}

void History::undo()
{
    expects(can_undo(), "History::undo: there is an operation to undo");
    --cursor_;
}

void History::redo()
{
    expects(can_redo(), "History::redo: there is an operation to do again");
    ++cursor_;
}

void History::add(Operation operation)
{
    all_.operations.resize(cursor_);
    all_.operations.push_back(std::move(operation));
    ++cursor_;
}

Expected<Replay> History::edit(int index, Operation operation, const ReplayOptions& options)
{
    expects(index >= 0 && index < cursor_, "History::edit: the operation is done");
    Design changed = design();
    changed.operations[index] = std::move(operation);
    auto result = replay(changed, options);
    if (result) {
        all_.operations[index] = changed.operations[index];
    }
    return result;
}

} // namespace rhombloom
