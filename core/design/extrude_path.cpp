// The drag: which candidate is taken, and how often the brush is repeated (Sec. 4.3).
#include <algorithm>
#include <optional>

#include "core/design/extrude.h"
#include "core/design/pose.h"
#include "core/model/validity.h"

namespace rhombloom {

namespace {

constexpr double follows = 0.8660254037844386; // cosine of 30 degrees
constexpr int max_periods = 200;
constexpr int trial_iterations = 2000; // a candidate that needs more is passed over
constexpr int embedded_choices = 8;   // candidates that are embedded before the best of them is taken

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
    double distance = 0; //!< of the tip from the end of the drag
    double cosine = 1;   //!< of the angle between the tip's way and the drag
    int next_serial = 0;
    ExtrudeCandidate candidate;

    bool good() const { return settled(embedding) && cosine >= follows; }
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
    result.candidate = candidate;
    return result;
}

//! Settled before not settled, then the one whose tip comes closest.
bool better(const Attempt& a, const Attempt& b)
{
    return std::pair(!settled(a.embedding), a.distance) < std::pair(!settled(b.embedding), b.distance);
}

tl::unexpected<Error> nothing_fits(const BaseShape& brush, const ExtrudeRequest& request, const std::string& reason)
{
    return refuse("no way to join " + brush.name + " at vertex " + std::to_string(request.apex.idx()) +
                  " can be built: " + reason);
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
    int embedded = 0;
    for (const ExtrudeCandidate& candidate : *candidates) {
        auto tried = attempt(target, element, request, candidate, embedding);
        if (!tried) {
            last = tried.error();
            continue;
        }
        if (tried->good()) {
            return tried;
        }
        if (!best || better(*tried, *best)) {
            best = std::move(*tried);
        }
        if (++embedded == embedded_choices) {
            break;
        }
    }
    return best ? Expected<Attempt>(std::move(*best)) : nothing_fits(brush, request, last.message);
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
                        "there is no candidate " + std::to_string(request.candidate) + ", only " +
                            std::to_string(found) + " settle");
}

Expected<Attempt> period(const Surface& target, const Element& element, const BaseShape& brush,
                         const ExtrudeRequest& request, const EmbedOptions& embedding)
{
    EmbedOptions limited = embedding;
    limited.max_iterations = std::min(embedding.max_iterations, trial_iterations);
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
    if (!(request.drag.norm() > 1e-3 * element.la)) {
        return refuse("the drag is shorter than a thousandth of an element: say how far and where to extrude");
    }
    const Vec3 start = target.point(request.apex);
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
        if (next.drag.norm() < 0.25 * element.la || reached->tips.size() > 1) {
            break;
        }
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
