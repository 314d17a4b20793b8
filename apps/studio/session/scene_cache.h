#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>

#include "core/design/scene.h"

namespace rhombloom::studio {

using ScenePointer = std::shared_ptr<const Scene>;

//! \brief Why a history cannot be carried out: the operation (index) and the reason.
struct Misfit
{
    int operation = 0;
    std::string reason;
};

//! \brief Scenes by the history that made them, so that an edit replays only what follows it and undo costs nothing.
//! \details The least recently used are forgotten. May be called from several threads.
class SceneCache
{
public:
    explicit SceneCache(std::size_t most = 120) : most_(most) {}

    //! The scene after all operations of \p design; the empty scene when there are none.
    tl::expected<ScenePointer, Misfit> scene(const Design& design);

private:
    ScenePointer find(const std::string& key);
    void keep(const std::string& key, ScenePointer scene);

    std::size_t most_;
    std::mutex mutex_;
    std::list<std::string> order_; //!< most recently used first
    std::map<std::string, std::pair<ScenePointer, std::list<std::string>::iterator>> scenes_;
};

} // namespace rhombloom::studio
