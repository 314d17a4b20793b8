// The drag: which candidate is taken, and how often the brush is repeated (Sec. 4.3).
#include <algorithm>
#include <optional>
#include <tuple>

#include "core/design/extrude.h"
#include "core/design/overlap.h"
#include "core/design/pose.h"
#include "core/model/validity.h"
#include "core/text.h"

namespace rhombloom {

namespace {

constexpr double follows = 0.8660254037844386; // cosine of 30 degrees
constexpr int max_periods = 200;
constexpr double longest_drag = 2e6;           // mm; design files allow a kilometre each way
constexpr int trial_iterations = 1000;         // a candidate that needs more is passed over
constexpr int most_trials = 3;                 // candidates that are embedded until one is at least usable;
constexpr std::size_t embedded_elements = 500; // more of them, for a good one, as long as they have no more elements
constexpr double usable_stretch = 0.05;

int next_serial(const Surface& surface)
{
    int next = 0;
    for (const Face f : surface.faces()) {
        next = std::max(next, surface.data(f).serial + 1);
    }
    return next;
}

//! One period, embedded.
struct Attempt
{
    Surface surface;
    EmbedReport embedding;
    std::vector<Vertex> tips;
    double distance = 0;  //!< of the tip from the end of the drag
    double cosine = 1;    //!< of the angle between the tip's way and the drag
    bool crosses = false; //!< two elements run through each other
    int next_serial = 0;
    ExtrudeCandidate candidate;

    bool stands() const { return settled(embedding) && !crosses; }
    bool usable() const
    {
        return embedding.converged && embedding.max_stretch < usable_stretch && !crosses && cosine >= follows;
    }
    bool good() const { return stands() && cosine >= follows; }
};

Expected<Attempt> attempt(const Surface& target, const Element& element, const ExtrudeRequest& request,
                          const ExtrudeCandidate& candidate, const EmbedOptions& embedding)
{
    const Symmetry none;
    auto grafts = symmetric_grafts(target, element, request.all_images ? request.symmetry : none, candidate.change);
    if (!grafts) {
        return tl::make_unexpected(grafts.error());
    }
    Attempt result;
    result.next_serial = request.first_serial >= 0 ? request.first_serial : next_serial(target);
    auto grafted = apply_grafts(target, *grafts, result.next_serial);
    if (!grafted) {
        return tl::make_unexpected(grafted.error());
    }
    if (const Validity validity = validate(grafted->surface, element); !validity.ok()) {
        return refuse(validity.problems.front());
    }
    result.surface = std::move(grafted->surface);
    result.embedding = embed_in_place(result.surface, target, grafted->number, element, embedding);
    result.tips = grafted->tips.front();
    const Vec3 way = middle(result.surface, result.tips) - target.point(request.apex);
    result.distance = (way - request.drag).norm();
    result.cosine = way.dot(request.drag) / std::max(1e-12, way.norm() * request.drag.norm());
    result.crosses = crosses_itself(result.surface);
    result.candidate = candidate;
    return result;
}

//! What stands before what does not; then the one whose tip comes closest or, where nothing stands, the least stretched
//! of those that follow the drag.
bool better(const Attempt& a, const Attempt& b)
{
    const auto key = [](const Attempt& x) {
        const bool calm = settled(x.embedding);
        return std::tuple(!x.embedding.converged, x.crosses, !calm, !calm && x.cosine < follows,
                          calm ? x.distance : x.embedding.max_stretch);
    };
    return key(a) < key(b);
}

tl::unexpected<Error> nothing_fits(const BaseShape& brush, const ExtrudeRequest& request, const std::string& reason)
{
    return refuse("no way to join " + brush.name + " at vertex " + std::to_string(request.apex.idx()) +
                  " can be built: " + reason);
}

//! \p found again with all repairs of the embedding, when that helps.
Attempt repaired(Attempt found, const Surface& target, const Element& element, const ExtrudeRequest& request,
                 EmbedOptions embedding)
{
    embedding.start = Start::Unknown;
    auto again = attempt(target, element, request, found.candidate, embedding);
    return again && better(*again, found) ? std::move(*again) : std::move(found);
}

//! The first good one, else the best of the first few.
Expected<Attempt> best_attempt(const Surface& target, const Element& element, const BaseShape& brush,
                               const ExtrudeRequest& request, const EmbedOptions& embedding)
{
    auto candidates = extrude_candidates(target, element, brush, request);
    if (!candidates) {
        return tl::make_unexpected(candidates.error());
    }
    std::optional<Attempt> best;
    Error last;
    int trials = 0;
    std::size_t elements = 0;
    for (const ExtrudeCandidate& candidate : *candidates) {
        auto tried = attempt(target, element, request, candidate, embedding);
        if (!tried) {
            last = tried.error();
            continue;
        }
        if (tried->good()) {
            return tried;
        }
        elements += tried->surface.n_faces();
        if (!best || better(*tried, *best)) {
            best = std::move(*tried);
        }
        if (elements > embedded_elements && (best->usable() || ++trials >= most_trials)) {
            break;
        }
    }
    if (!best) {
        return nothing_fits(brush, request, last.message);
    }
    return best->embedding.converged ? std::move(*best)
                                     : repaired(std::move(*best), target, element, request, embedding);
}

//! The one of the wanted rank among those that settle.
Expected<Attempt> ranked_attempt(const Surface& target, const Element& element, const BaseShape& brush,
                                 const ExtrudeRequest& request, const EmbedOptions& embedding)
{
    auto candidates = extrude_candidates(target, element, brush, request, 2 * request.candidate + 24);
    if (!candidates) {
        return tl::make_unexpected(candidates.error());
    }
    int found = 0;
    for (const ExtrudeCandidate& candidate : *candidates) {
        auto tried = attempt(target, element, request, candidate, embedding);
        if (tried && settled(tried->embedding) && found++ == request.candidate) {
            return tried;
        }
    }
    return nothing_fits(brush, request,
                        "there is no candidate " + std::to_string(request.candidate) + ": choose " +
                            (found > 1 ? "one from 0 to " + std::to_string(found - 1) : "0, the only one"));
}

//! Another period gains about as much as the last one: it must not overshoot by more than is left, nor go back.
bool worth_a_period(const Vec3& left, const Vec3& drag, double gained)
{
    return left.dot(drag) > 0 && left.norm() > 0.4 * gained;
}

Expected<Attempt> period(const Surface& target, const Element& element, const BaseShape& brush,
                         const ExtrudeRequest& request, const EmbedOptions& embedding)
{
    EmbedOptions limited = embedding;
    limited.max_iterations = std::min(embedding.max_iterations, trial_iterations);
    limited.start = Start::Edited;
    return request.candidate > 0 ? ranked_attempt(target, element, brush, request, limited)
                                 : best_attempt(target, element, brush, request, limited);
}

} // namespace

Expected<Extrusion> extrude(const Surface& target, const Element& element, const BaseShape& brush,
                            const ExtrudeRequest& request, const EmbedOptions& embedding)
{
    if (!request.apex.is_valid() || request.apex.idx() >= static_cast<int>(target.n_vertices())) {
        return refuse("the apex is vertex " + std::to_string(request.apex.idx()) + ", but the surface has " +
                      std::to_string(target.n_vertices()) + " vertices");
    }
    if (!request.drag.allFinite() || request.drag.norm() > longest_drag) {
        return refuse("the drag is not a length: expected three finite numbers, together at most " +
                      to_text(longest_drag) + " mm");
    }
    if (request.drag.norm() <= 1e-3 * element.la) {
        return refuse("the drag is shorter than a thousandth of an element: say how far and where to extrude");
    }
    const Vec3 start = target.point(request.apex);
    Vec3 before = start;
    auto reached = period(target, element, brush, request, embedding);
    if (!reached) {
        return tl::make_unexpected(reached.error());
    }
    Extrusion result;
    result.first = reached->candidate;
    result.periods = 1;
    ExtrudeRequest next = request;
    next.candidate = 0;
    while (result.periods < max_periods) {
        next.apex = reached->tips.front();
        next.first_serial = reached->next_serial;
        next.drag = start + request.drag - middle(reached->surface, reached->tips);
        const double gained = (middle(reached->surface, reached->tips) - before).norm();
        if (!worth_a_period(next.drag, request.drag, gained) || reached->tips.size() > 1) {
            break;
        }
        before = middle(reached->surface, reached->tips);
        auto further = period(reached->surface, element, brush, next, embedding);
        if (!further || further->distance >= reached->distance || !settled(further->embedding)) {
            break;
        }
        reached = std::move(further);
        ++result.periods;
    }
    result.surface = std::move(reached->surface);
    result.embedding = reached->embedding;
    result.tips = reached->tips;
    result.next_serial = reached->next_serial;
    result.reached = middle(result.surface, result.tips) - start;
    return result;
}

} // namespace rhombloom
