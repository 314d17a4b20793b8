#include "apps/studio/session/pull.h"

#include <algorithm>
#include <limits>

#include "core/design/pose.h"

namespace rhombloom::studio {

namespace {

constexpr double follows = 0.8660254037844386; // cosine of 30 degrees, as on release
constexpr double turned = 0.9659258262890683;  // cosine of 15 degrees: then the first choice is made again
constexpr std::size_t most_periods = 24;       // while dragging; the exact operation may add more

Vec3 middle_of(const std::vector<Vec3>& points)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) {
        sum += p / static_cast<double>(points.size());
    }
    return sum;
}

//! Where the change puts the new tip before anything is embedded.
Vec3 predicted_tip(const Graft& change, const Surface& target)
{
    std::vector<Vec3> points;
    const int old = static_cast<int>(target.n_vertices());
    for (const int v : change.tips) {
        points.push_back(v < old ? target.point(Vertex(v)) : change.positions[v - old]);
    }
    return middle_of(points);
}

} // namespace

Pull::Pull(ScenePointer scene, const Design& design, BaseShape brush, const PullStart& start)
    : scene_(std::move(scene)), element_(design.element), symmetry_(design.symmetry), brush_(std::move(brush)),
      start_(start)
{
}

Expected<Pull> Pull::begin(ScenePointer scene, const Design& design, const PullStart& start)
{
    const auto& parts = scene->parts;
    const auto on = std::find_if(parts.begin(), parts.end(), [&](const ScenePart& p) { return p.id == start.on; });
    if (on == parts.end()) {
        return refuse("there is no part \"" + start.on.substr(0, 60) + "\"");
    }
    if (start.vertex < 0 || start.vertex >= static_cast<int>(on->surface.n_vertices())) {
        return refuse("there is no vertex " + std::to_string(start.vertex));
    }
    if (start.symmetric && design.symmetry.kind == Symmetry::Kind::None) {
        return refuse("the design declares no symmetry");
    }
    auto brush = base_shape(start.brush, design.element);
    if (!brush) {
        return tl::make_unexpected(brush.error());
    }
    constexpr std::size_t largest_brush = 1000; // more elements cannot be dragged at any speed
    if (brush->surface.n_faces() > largest_brush) {
        return refuse(start.brush + " is too large to be pulled: use a brush of at most 1000 elements");
    }
    embed_in_place(brush->surface, design.element, {});
    return Pull(std::move(scene), design, std::move(*brush), start);
}

const ScenePart& Pull::part() const
{
    return *std::find_if(scene_->parts.begin(), scene_->parts.end(),
                         [&](const ScenePart& p) { return p.id == start_.on; });
}

const Surface& Pull::below(std::size_t level) const
{
    return level == 0 ? part().surface : levels_[level - 1].made->surface;
}

Vec3 Pull::start() const
{
    return part().surface.point(Vertex(start_.vertex));
}

ExtrudeRequest Pull::request(std::size_t level, const Vec3& by) const
{
    ExtrudeRequest request;
    request.apex = level == 0 ? Vertex(start_.vertex) : levels_[level - 1].made->tips.front().front();
    request.drag = level == 0 ? by : Vec3(start() + by - levels_[level - 1].tip);
    request.component = "limb";
    request.symmetry = symmetry_;
    request.all_images = start_.symmetric;
    request.first_serial = scene_->next_serial;
    return request;
}

//! The first candidate whose predicted tip follows the drag, else the one that comes closest.
Expected<Pull::Level> Pull::grow(std::size_t level, const Vec3& by) const
{
    const Surface& target = below(level);
    const ExtrudeRequest wanted = request(level, by);
    auto candidates = extrude_candidates(target, element_, brush_, wanted);
    if (!candidates) {
        return tl::make_unexpected(candidates.error());
    }
    const Vec3 apex = target.point(wanted.apex);
    std::stable_sort(candidates->begin(), candidates->end(), [&](const auto& a, const auto& b) {
        const auto key = [&](const ExtrudeCandidate& c) {
            const Vec3 way = predicted_tip(c.change, target) - apex;
            const double cosine = way.dot(wanted.drag) / std::max(1e-9, way.norm() * wanted.drag.norm());
            return cosine >= follows ? 0.0 : 1 + (way - wanted.drag).norm();
        };
        return key(a) < key(b);
    });
    Error last;
    for (ExtrudeCandidate& candidate : *candidates) {
        const Symmetry none;
        const auto grafts = symmetric_grafts(target, element_, start_.symmetric ? symmetry_ : none, candidate.change);
        int serial = scene_->next_serial;
        auto made =
            grafts ? apply_grafts(target, *grafts, serial) : Expected<Grafted>(tl::make_unexpected(grafts.error()));
        if (made) {
            return Level{std::move(candidate), std::make_shared<Grafted>(std::move(*made)), Vec3::Zero(), false};
        }
        last = made.error();
    }
    return tl::make_unexpected(last);
}

void Pull::settle(Level& level, const Surface& before, double budget_s)
{
    EmbedOptions options;
    options.time_budget_s = budget_s;
    options.threads = 1; // a drag leaves the other cores to the page that draws it
    Surface& surface = level.made->surface;
    const EmbedReport report = embed_in_place(surface, before, level.made->number, element_, options);
    level.settled = report.converged;
    level.tip = middle(surface, level.made->tips.front());
}

//! Drop the levels that the drag no longer reaches and choose the first one again when the drag has turned.
void Pull::fit_levels(const Vec3& by)
{
    const Vec3 end = start() + by;
    const double cosine = by.dot(chosen_for_) / std::max(1e-9, by.norm() * chosen_for_.norm());
    if (cosine < turned) {
        levels_.clear();
    }
    const auto tip = [&](std::size_t k) { return k == 0 ? start() : levels_[k - 1].tip; };
    while (!levels_.empty() && (tip(levels_.size() - 1) - end).norm() < (tip(levels_.size()) - end).norm()) {
        levels_.pop_back();
    }
}

PullFrame Pull::drag(const Vec3& wanted, double budget_s)
{
    constexpr double most_sides = 100; // as limits.h has it for the operation
    const Vec3 by = wanted * std::min(1.0, most_sides * element_.la / std::max(1e-9, wanted.norm()));
    fit_levels(by);
    const double left = levels_.empty() ? by.norm() : (start() + by - levels_.back().tip).norm();
    const bool ready = levels_.empty() || levels_.back().settled;
    const bool one_tip = levels_.empty() || levels_.back().made->tips.front().size() == 1;
    if (ready && one_tip && left > 0.25 * element_.la && levels_.size() < most_periods) {
        auto next = grow(levels_.size(), by);
        reason_ = next || !levels_.empty() ? "" : next.error().message;
        if (next) {
            const Vec3 end = start() + by;
            settle(*next, below(levels_.size()), budget_s);
            if ((next->tip - end).norm() < left) {
                chosen_for_ = levels_.empty() ? by : chosen_for_;
                levels_.push_back(std::move(*next));
            }
        }
    } else if (!ready) {
        settle(levels_.back(), below(levels_.size() - 1), budget_s);
    }
    return {&below(levels_.size()), static_cast<int>(levels_.size()), levels_.empty() || levels_.back().settled,
            reason_};
}

} // namespace rhombloom::studio
