// This work is based on "Interactive Surface Design with Interlocking Elements" (Skouras, Coros, Grinspun,
// Thomaszewski 2015), Section 4.2.
#include "core/design/merge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/design/merge_seams.h"
#include "core/design/pose.h"
#include "core/model/validity.h"

namespace rhombloom {

namespace {

constexpr int interfaces_tried = 160;          // per surface
constexpr int subsets_tried = 4000;            // per surface
constexpr int choices_built = 40;              // best-scored choices that are made into changes until enough are valid
constexpr int most_candidates = 8;             // asked for beyond the wanted one
constexpr int most_trials = 8;                 // candidates that are embedded until one is at least usable;
constexpr std::size_t embedded_elements = 500; // more of them, for a good one, as long as they have no more elements
constexpr double usable_stretch = 0.05;
constexpr double far_off = 0.4;       // la rms from the union of the inputs: the next candidate is tried
constexpr double stretch_weight = 10; // la of distance that are as bad as a stretch of 1
constexpr int trial_iterations = 1000;

MergeCandidate candidate(const MergeChoice& choice, const Surface& a, const Surface& b)
{
    Cut cut_a = choice.a->cut;
    Cut cut_b = choice.b->cut;
    std::vector<Seam> seams;
    Interface all_a;
    Interface all_b;
    for (const SeamChoice& seam : choice.seams) {
        cut_a.loops[seam.loop_a] = seam.a;
        cut_b.loops[seam.loop_b] = seam.b;
        seams.push_back({seam.loop_a, seam.loop_b, seam.match});
        for (int i = 0; i < seam.a.size(); ++i) {
            all_a.vertices.push_back(i);
            all_a.points.push_back(seam.a.points[i]);
            all_b.points.insert(all_b.points.begin(), seam.b.points[partner(seam.match, i, seam.a.size())]);
        }
    }
    // Both lists are matched in opposite order, so the correspondence of the whole is the shift n - 1.
    const Eigen::Isometry3d pose = alignment(all_a, all_b, {all_a.size() - 1, 0, 0});
    MergeCandidate result;
    result.removed_a = static_cast<int>(cut_a.removed.size());
    result.removed_b = static_cast<int>(cut_b.removed.size());
    result.loop_size = choice.loop_size;
    result.zips = choice.zips;
    result.distance = choice.distance;
    result.off_union = choice.off_union;
    result.min_defect = choice.min_defect;
    result.max_defect = choice.max_defect;
    result.asymmetry = choice.asymmetry;
    result.score = choice.score;
    result.change = graft({a, cut_a}, {b, cut_b}, seams, pose);
    return result;
}

//! One seam that leaves every edge with two elements makes a valid surface of two valid ones; with several, sides and
//! connection have to be seen.
bool is_valid(const MergeChoice& choice, const Graft& change, const Surface& a, const Element& element)
{
    if (choice.seams.size() == 1) {
        return edges_fit(a, change);
    }
    int unused = 1 << 30;
    const auto grafted = apply_grafts(a, {change}, unused);
    return grafted && validate(grafted->surface, element).ok();
}

std::vector<MergeCandidate> valid_candidates(const std::vector<MergeChoice>& choices, const Surface& a,
                                             const Surface& b, const Element& element, int count)
{
    std::vector<MergeCandidate> result;
    for (std::size_t i = 0; i < choices.size() && static_cast<int>(result.size()) < count; ++i) {
        MergeCandidate made = candidate(choices[i], a, b);
        if (is_valid(choices[i], made.change, a, element)) {
            result.push_back(std::move(made));
        }
    }
    return result;
}

struct Meeting
{
    MeetingSide a;
    MeetingSide b;
};

bool any_outside(const MeetingSide& side)
{
    return std::find(side.outside.begin(), side.outside.end(), 1) != side.outside.end();
}

Expected<Meeting> meeting(const Surface& a, const Surface& b, const Element& element)
{
    constexpr double touching = 1e-6; // of la
    const Overlap where = overlap(a, b, touching * element.la);
    if (!where.any) {
        const bool inside = winding_number(a, b.point(Vertex(0))) > 0.5 || winding_number(b, a.point(Vertex(0))) > 0.5;
        return refuse(inside ? "one part lies inside the other: move them until they intersect"
                             : "the parts do not touch: move them closer until they intersect");
    }
    Meeting result{merge_side(a, where.a, b), merge_side(b, where.b, a)};
    if (!any_outside(result.a) && !any_outside(result.b)) {
        return refuse("every element of both parts touches the other part: move them apart a little");
    }
    return result;
}

using Interfaces = std::vector<MergeInterface>;

tl::unexpected<Error> no_candidate(const Interfaces& a, const Interfaces& b, std::size_t compatible)
{
    if (a.empty() || b.empty()) {
        return refuse("no closed loop of edges divides one of the parts near the intersection: move the parts so that "
                      "they intersect more evenly");
    }
    const std::string tried = std::to_string(a.size()) + " x " + std::to_string(b.size()) + " pairs of loops";
    if (compatible == 0) {
        return refuse("none of " + tried + " near the intersection keeps the permissible defects: turn or move a part");
    }
    return refuse("none of " + tried +
                  " near the intersection joins to a surface that can be built: turn or move a part");
}

//! At most \p count candidates that the best choices among \p loops of both surfaces make.
Expected<std::vector<MergeCandidate>> candidates_of(const Meeting& where, const std::array<Interfaces, 2>& loops,
                                                    const Element& element, const SeamOptions& wanted, int count)
{
    const auto choices = best_choices(loops[0], loops[1], element, wanted);
    auto result = valid_candidates(choices, where.a.surface, where.b.surface, element, count);
    if (result.empty()) {
        return no_candidate(loops[0], loops[1], choices.size());
    }
    return result;
}

} // namespace

Expected<std::vector<MergeCandidate>> four_candidates(const Surface& a, const Surface& b, const Element& element,
                                                      const MergeOptions& options)
{
    const auto where = meeting(a, b, element);
    if (!where) {
        return tl::make_unexpected(where.error());
    }
    return candidates_of(*where, {paper_interfaces(where->a, element), paper_interfaces(where->b, element)}, element,
                         {1, choices_built, 4, options.symmetry}, options.count);
}

namespace {

Expected<std::vector<MergeCandidate>> search(const Meeting& where, const Element& element, const MergeOptions& options)
{
    SeamOptions wanted;
    wanted.count = choices_built;
    wanted.symmetry = options.symmetry;
    return candidates_of(where,
                         {nearby_interfaces(where.a, element, interfaces_tried, subsets_tried),
                          nearby_interfaces(where.b, element, interfaces_tried, subsets_tried)},
                         element, wanted, options.count);
}

bool looks_symmetric(const std::vector<MergeCandidate>& candidates, const Element& element)
{
    return candidates.front().asymmetry < 0.1 * element.la;
}

} // namespace

Expected<std::vector<MergeCandidate>> merge_candidates(const Surface& a, const Surface& b, const Element& element,
                                                       const MergeOptions& options)
{
    const auto where = meeting(a, b, element);
    if (!where) {
        return tl::make_unexpected(where.error());
    }
    if (options.symmetry.kind != Symmetry::Kind::None) {
        Meeting tied = *where;
        if (tie_images(tied.a, element, options.symmetry) && tie_images(tied.b, element, options.symmetry)) {
            auto result = search(tied, element, options);
            if (result && looks_symmetric(*result, element)) {
                return result;
            }
        }
    }
    return search(*where, element, options);
}

namespace {

//! A candidate, embedded, with what speaks for it.
struct Trial
{
    Merged merged;
    bool crosses = false; //!< two elements run through each other
    double off = 0;       //!< rms distance of the vertices from both inputs, la

    bool usable() const
    {
        const EmbedReport& report = merged.embedding;
        return report.converged && report.max_stretch < usable_stretch && !crosses && off <= far_off;
    }
    bool good() const { return settled(merged.embedding) && !crosses && off <= far_off; }
};

//! What is joined: both surfaces and, when asked for, the images of the second.
struct Inputs
{
    const Surface& a;
    const Surface& b;
    const Element& element;
    const MergeOptions& options;
    std::vector<Surface> all;
    int first_serial = 0;
};

int serial_after(const Surface& surface)
{
    int next = 0;
    for (const Face f : surface.faces()) {
        next = std::max(next, surface.data(f).serial + 1);
    }
    return next;
}

Inputs inputs(const Surface& a, const Surface& b, const Element& element, const MergeOptions& options)
{
    Inputs result{a, b, element, options, {a, b}};
    result.first_serial = std::max({options.first_serial, serial_after(a), serial_after(b)});
    for (const SymmetryImage& image : options.all_images ? images(options.symmetry) : std::vector<SymmetryImage>{}) {
        Surface& copy = result.all.emplace_back(b);
        for (const Vertex v : copy.vertices()) {
            copy.set_point(v, image.map * copy.point(v));
        }
    }
    return result;
}

Expected<Trial> trial(const MergeCandidate& candidate, const Inputs& in, const EmbedOptions& embedding)
{
    const Symmetry symmetry = in.options.all_images ? in.options.symmetry : Symmetry{};
    auto grafts = symmetric_grafts(in.a, in.element, symmetry, candidate.change);
    if (!grafts) {
        return tl::make_unexpected(grafts.error());
    }
    Trial result;
    result.merged.candidate = candidate;
    result.merged.next_serial = in.first_serial;
    auto grafted = apply_grafts(in.a, *grafts, result.merged.next_serial);
    if (!grafted) {
        return tl::make_unexpected(grafted.error());
    }
    if (const Validity validity = validate(grafted->surface, in.element); !validity.ok()) {
        return refuse(validity.problems.front());
    }
    result.merged.surface = std::move(grafted->surface);
    const Surface& surface = result.merged.surface;
    result.merged.embedding = embed_in_place(result.merged.surface, in.a, grafted->number, in.element, embedding);
    result.crosses = crosses_itself(surface);
    result.off = rms_distance(surface, in.all) / in.element.la;
    return result;
}

bool better(const Trial& a, const Trial& b)
{
    const auto key = [](const Trial& t) {
        const EmbedReport& embedding = t.merged.embedding;
        return std::tuple(!embedding.converged, t.crosses, t.off > far_off, !settled(embedding),
                          t.off + stretch_weight * embedding.max_stretch);
    };
    return key(a) < key(b);
}

//! \p found again with all repairs of the embedding, when that helps.
Trial repaired(Trial found, const Inputs& in)
{
    auto again = trial(found.merged.candidate, in, in.options.embedding);
    return again && better(*again, found) ? std::move(*again) : std::move(found);
}

} // namespace

Expected<Merged> merge(const Surface& a, const Surface& b, const Element& element, int index,
                       const MergeOptions& options)
{
    MergeOptions enough = options;
    enough.count = std::max(options.count, index + most_candidates);
    const auto candidates = merge_candidates(a, b, element, enough);
    if (!candidates) {
        return tl::make_unexpected(candidates.error());
    }
    EmbedOptions quick = options.embedding;
    quick.start = Start::Edited;
    quick.max_iterations = std::min(quick.max_iterations, trial_iterations);
    const Inputs in = inputs(a, b, element, options);
    std::optional<Trial> best;
    Error last;
    int found = 0;
    std::size_t elements = 0;
    for (std::size_t k = 0; k < candidates->size(); ++k) {
        if (index == 0 && elements > embedded_elements && (best->usable() || k >= most_trials)) {
            break;
        }
        auto tried = trial((*candidates)[k], in, quick);
        if (!tried) {
            last = tried.error();
            continue;
        }
        elements += tried->merged.surface.n_faces();
        if (tried->good() && found++ == index) {
            return std::move(tried->merged);
        }
        if (!best || better(*tried, *best)) {
            best = std::move(*tried);
        }
    }
    if (!best) {
        return tl::make_unexpected(last);
    }
    if (index > 0) {
        return refuse("there is no candidate " + std::to_string(index) + ": choose " +
                      (found > 1 ? "one from 0 to " + std::to_string(found - 1) : "0, the only one"));
    }
    return best->merged.embedding.converged ? std::move(best->merged) : repaired(std::move(*best), in).merged;
}

} // namespace rhombloom
