#pragma once

#include <chrono>

#include "apps/studio/session/scene_cache.h"
#include "core/design/extrude.h"

namespace rhombloom::studio {

//! \brief What is pulled: a brush, from a vertex of a part.
struct PullStart
{
    std::string on;
    int vertex = 0;
    std::string brush;
    bool symmetric = false;
};

//! \brief What the limb looks like so far.
struct PullFrame
{
    const Surface* surface = nullptr; //!< of the whole part
    int periods = 0;                  //!< 0: nothing has grown yet
    bool settled = false;             //!< the shape is in equilibrium; else coarse, better with every frame
    std::string reason;               //!< why nothing grows; empty when it does
};

//! \brief An extrusion while it is being dragged: coarse, a few milliseconds a frame, carried on from frame to frame.
//! \details The same candidates as extrude() in the same order, but chosen by where the rigid alignment puts the tip
//! instead of after embedding each; the exact operation on release decides.
class Pull
{
public:
    static Expected<Pull> begin(ScenePointer scene, const Design& design, const PullStart& start);

    //! Follow the drag to \p wanted (mm from the apex), spending about \p budget_s on the shape.
    PullFrame drag(const Vec3& wanted, double budget_s);

private:
    //! One period: the surface before it is the one of the level below.
    struct Level
    {
        ExtrudeCandidate candidate;
        std::shared_ptr<Grafted> made; //!< its surface is embedded a little more with every frame
        Vec3 tip = Vec3::Zero();
        bool settled = false;
    };

    Pull(ScenePointer scene, const Design& design, BaseShape brush, const PullStart& start);

    const ScenePart& part() const;
    const Surface& below(std::size_t level) const;
    Vec3 start() const;
    ExtrudeRequest request(std::size_t level, const Vec3& by) const;
    Expected<Level> grow(std::size_t level, const Vec3& by) const;
    void fit_levels(const Vec3& by);
    void settle(Level& level, const Surface& before, double budget_s);

    ScenePointer scene_;
    Element element_;
    Symmetry symmetry_;
    BaseShape brush_;
    PullStart start_;
    std::vector<Level> levels_;
    Vec3 chosen_for_ = Vec3::Zero(); //!< the drag that the first level was chosen for
    std::string reason_;
};

} // namespace rhombloom::studio
