#include "apps/studio/server/merge_preview.h"

#include <algorithm>
#include <chrono>

#include "apps/studio/server/motion.h"
#include "core/design/pose.h"

namespace rhombloom::studio {

namespace {

constexpr int most_candidates = 12;

const Surface* part_surface(const Scene& scene, const std::string& id)
{
    const auto found =
        std::find_if(scene.parts.begin(), scene.parts.end(), [&](const ScenePart& p) { return p.id == id; });
    return found == scene.parts.end() ? nullptr : &found->surface;
}

bool same(const MergeQuestion& a, const MergeQuestion& b)
{
    return a.scene == b.scene && a.on == b.on && a.with == b.with && a.motion.matrix() == b.motion.matrix();
}

MergeOptions options(const MergeQuestion& question)
{
    MergeOptions result;
    result.count = most_candidates;
    result.symmetry = question.symmetry;
    return result;
}

Vec3 middle_of(const Surface& surface)
{
    const std::vector<Vertex> all(surface.vertices_begin(), surface.vertices_end());
    return middle(surface, all);
}

struct Trial
{
    Eigen::Isometry3d motion;
    std::string kind;
    double amount;
};

Eigen::Isometry3d turn_about(const Vec3& point, const Vec3& axis, double angle)
{
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.translate(point);
    result.rotate(Eigen::AngleAxisd(angle, axis));
    result.translate(-point);
    return result;
}

//! Motions to try after the question's own, the smaller first.
std::vector<Trial> trials(const Surface& a, const Surface& b, double la)
{
    const Vec3 centre = middle_of(b);
    const Vec3 apart = centre - middle_of(a);
    const Vec3 axis = apart.norm() > 1e-6 ? Vec3(apart.normalized()) : Vec3::UnitZ();
    const Vec3 across = axis.unitOrthogonal();
    std::vector<Trial> result;
    for (const double step : {0.25, 0.5, 0.75, 1.0, 1.5}) {
        for (const double sign : {-1.0, 1.0}) {
            Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
            move.translate(sign * step * la * axis);
            result.push_back({move, sign < 0 ? "closer" : "apart", step * la});
        }
        const double angle = 36 * step;
        for (const double sign : {-1.0, 1.0}) {
            result.push_back({turn_about(centre, axis, sign * radians(angle)), "turn", sign * angle});
        }
        for (const double sign : {-1.0, 1.0}) {
            Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
            move.translate(sign * step * la * across);
            result.push_back({move, "aside", step * la});
        }
    }
    return result;
}

} // namespace

void MergePreview::ask(const MergeQuestion& question)
{
    question_ = question;
    reason_.clear();
    untried_.clear();
    found_.clear();
    unsettled_.reset();
    next_ = 0;
    const Surface* a = part_surface(*question.scene, question.on);
    const Surface* b = part_surface(*question.scene, question.with);
    if (a == nullptr || b == nullptr || a == b) {
        reason_ = "a merge needs two different parts";
        return;
    }
    a_ = *a;
    auto candidates = merge_candidates(*a, moved(*b, question.motion), question.element, options(question));
    if (!candidates) {
        reason_ = candidates.error().message;
        return;
    }
    untried_ = std::move(*candidates);
}

//! Embed candidates until one more has settled; false when there is none left.
bool MergePreview::find_next()
{
    while (next_ < untried_.size()) {
        const MergeCandidate& candidate = untried_[next_++];
        int unused = 1 << 30;
        auto grafted = apply_grafts(a_, {candidate.change}, unused);
        if (!grafted) {
            continue;
        }
        const EmbedReport report = embed_in_place(grafted->surface, a_, grafted->number, question_->element, {});
        Found found{candidate, report.max_stretch, std::make_shared<Surface>(std::move(grafted->surface))};
        if (settled(report)) {
            found_.push_back(std::move(found));
            return true;
        }
        unsettled_ = std::move(found);
    }
    return false;
}

MergeAnswer MergePreview::answer(const MergeQuestion& question, int candidate)
{
    const std::scoped_lock lock(mutex_);
    if (!question_ || !same(*question_, question)) {
        ask(question);
    }
    bool more = true;
    while (more && static_cast<int>(found_.size()) <= candidate) {
        more = find_next();
    }
    MergeAnswer result;
    result.complete = next_ == untried_.size();
    result.reason = reason_;
    for (const Found& found : found_) {
        result.candidates.push_back(found.candidate);
        result.candidates.back().change = {};
        result.stretches.push_back(found.stretch);
    }
    if (candidate < static_cast<int>(found_.size())) {
        result.surface = found_[candidate].surface;
    } else if (candidate == 0 && unsettled_) {
        result.surface = unsettled_->surface;
        result.candidates.push_back(unsettled_->candidate);
        result.stretches.push_back(unsettled_->stretch);
    } else if (result.reason.empty()) {
        result.reason = "there is no further way to join them here";
    }
    return result;
}

std::optional<MergeHint> merge_hint(const MergeQuestion& question, double budget_s)
{
    const auto start = std::chrono::steady_clock::now();
    const Surface* a = part_surface(*question.scene, question.on);
    const Surface* b = part_surface(*question.scene, question.with);
    if (a == nullptr || b == nullptr || a == b) {
        return std::nullopt;
    }
    const Surface posed = moved(*b, question.motion);
    for (const Trial& trial : trials(*a, posed, question.element.la)) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        if (spent.count() > budget_s) {
            break;
        }
        if (merge_candidates(*a, moved(posed, trial.motion), question.element, options(question))) {
            return MergeHint{trial.motion, trial.kind, trial.amount};
        }
    }
    return std::nullopt;
}

} // namespace rhombloom::studio
