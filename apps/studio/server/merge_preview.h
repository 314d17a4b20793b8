#pragma once

#include <mutex>
#include <optional>

#include "apps/studio/session/scene_cache.h"
#include "core/design/merge.h"

namespace rhombloom::studio {

//! \brief Two parts of a scene, the second one moved.
struct MergeQuestion
{
    ScenePointer scene;
    Element element;
    Symmetry symmetry;
    std::string on;
    std::string with;
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
};

struct MergeAnswer
{
    std::string reason;                          //!< why there is no such candidate; empty when there is
    std::vector<MergeCandidate> candidates = {}; //!< that settle, as far as looked for, best first
    std::vector<double> stretches = {};          //!< largest stretch of each of them
    std::shared_ptr<const Surface> surface;      //!< merged and embedded
    bool complete = false;                       //!< no further candidate will be found
};

//! \brief Candidates of a merge one after the other, in the order that the merge operation counts them.
//! \details The last question is remembered, so that stepping through its candidates embeds each once.
class MergePreview
{
public:
    MergeAnswer answer(const MergeQuestion& question, int candidate);

private:
    struct Found
    {
        MergeCandidate candidate;
        double stretch = 0;
        std::shared_ptr<const Surface> surface;
    };

    void ask(const MergeQuestion& question);
    bool find_next();

    std::mutex mutex_;
    std::optional<MergeQuestion> question_;
    Surface a_;
    std::string reason_;
    std::vector<MergeCandidate> untried_;
    std::size_t next_ = 0;
    std::vector<Found> found_;
    std::optional<Found> unsettled_; //!< what the merge falls back to
};

//! \brief A motion near the question's with which the parts do merge, and what it is, for people.
struct MergeHint
{
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    std::string kind;  //!< "closer", "apart", "turn", "aside"
    double amount = 0; //!< mm, or degrees of a turn
};

//! \brief Look for such a motion, the smallest first, for at most \p budget_s seconds.
std::optional<MergeHint> merge_hint(const MergeQuestion& question, double budget_s);

} // namespace rhombloom::studio
