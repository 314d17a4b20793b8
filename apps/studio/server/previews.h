#pragma once

#include <array>

#include "apps/studio/server/merge_preview.h"
#include "apps/studio/server/reply.h"
#include "apps/studio/session/pull.h"
#include "apps/studio/session/session.h"

namespace rhombloom::studio {

//! \brief What would happen: pulls while they are dragged, ways to merge, an operation tried out. Changes nothing.
class Previews
{
public:
    //! POST /api/pull: {"pull": number of the drag, "revision", "on", "vertex", "brush", "symmetric", "by_mm"}.
    //! Geometry of the whole scene; its header has "periods", "settled", "reason" and what it took: "work_ms" on the
    //! clock, "cpu_ms" of computing.
    Reply pull(const Session& session, const Request& request);

    //! POST /api/merge: {"revision", "on", "with", a motion of the second part, "candidate"}. Geometry of the scene
    //! merged by that candidate; the header lists all that were found so far, or the "reason" why there is none.
    Reply merge(const Session& session, const Request& request);

    //! POST /api/hint: the same body; a motion near the present one with which the parts do merge.
    Reply hint(const Session& session, const Request& request);

    //! POST /api/try: {"revision", "operation", "alone"}. Geometry of the scene after it, or the reason why not; alone:
    //! of an empty scene.
    Reply try_operation(const Session& session, const Request& request);

private:
    struct RunningPull
    {
        std::mutex mutex;
        long revision = 0;
        PullStart start;
        std::optional<Pull> pull;
        std::string reason; //!< why it could not begin
    };

    std::shared_ptr<RunningPull> running_pull(int number);

    std::mutex mutex_;
    std::list<std::pair<int, std::shared_ptr<RunningPull>>> pulls_; //!< most recent first
    MergePreview merge_;
};

} // namespace rhombloom::studio
