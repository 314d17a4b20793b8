#include "apps/studio/session/scene_cache.h"

#include "core/design/design_file.h"
#include "core/design/operation_file.h"

namespace rhombloom::studio {

namespace {

//! One key per prefix of the history: equal keys give equal scenes, because replay is deterministic.
std::vector<std::string> prefix_keys(const Design& design)
{
    Design head;
    head.element = design.element;
    head.symmetry = design.symmetry;
    std::vector<std::string> keys = {write_design(head)};
    for (const Operation& operation : design.operations) {
        keys.push_back(keys.back() + write_operation(operation).dump());
    }
    return keys;
}

} // namespace

ScenePointer SceneCache::find(const std::string& key)
{
    const std::scoped_lock lock(mutex_);
    const auto found = scenes_.find(key);
    if (found == scenes_.end()) {
        return nullptr;
    }
    order_.splice(order_.begin(), order_, found->second.second);
    return found->second.first;
}

void SceneCache::keep(const std::string& key, ScenePointer scene)
{
    const std::scoped_lock lock(mutex_);
    if (scenes_.contains(key)) {
        return;
    }
    order_.push_front(key);
    scenes_.emplace(key, std::pair(std::move(scene), order_.begin()));
    if (order_.size() > most_) {
        scenes_.erase(order_.back());
        order_.pop_back();
    }
}

tl::expected<ScenePointer, Misfit> SceneCache::scene(const Design& design)
{
    const std::vector<std::string> keys = prefix_keys(design);
    std::size_t done = design.operations.size();
    ScenePointer current = find(keys[done]);
    while (current == nullptr && done > 0) {
        current = find(keys[--done]);
    }
    if (current == nullptr) {
        current = std::make_shared<Scene>();
    }
    for (; done < design.operations.size(); ++done) {
        auto next = std::make_shared<Scene>(*current);
        if (auto ok = carry_out(design.operations[done], design, {}, *next); !ok) {
            return tl::make_unexpected(Misfit{static_cast<int>(done), ok.error().message});
        }
        current = next;
        keep(keys[done + 1], current);
    }
    return current;
}

} // namespace rhombloom::studio
