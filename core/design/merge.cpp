// This work is based on "Interactive Surface Design with Interlocking Elements" (Skouras, Coros, Grinspun,
// Thomaszewski 2015), Section 4.2.
#include "core/design/merge.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/design/merge_interfaces.h"
#include "core/design/pose.h"
#include "core/model/validity.h"

namespace rhombloom {

namespace {

constexpr int interfaces_tried = 160; // per surface
constexpr int subsets_tried = 6000;   // per surface
constexpr int pairs_tried = 8000;
constexpr int zip_variants = 6;
constexpr int most_zips = 4;
constexpr int choices_built = 40; // best-scored choices that are built and validated until enough are valid

constexpr double off_union_weight = 0.25; // per la of summed depth
constexpr double zip_weight = 0.15;       // per mountain made one
constexpr double margin_weight = 1.0;     // at the limit of the permissible defects, fading over comfortable_margin
constexpr double asymmetry_weight = 2.0;  // per la
constexpr double comfortable_margin = radians(40);

//! One loop of each surface and how they match.
struct SeamChoice
{
    int loop_a = 0;
    int loop_b = 0;
    Interface a;
    Interface b;
    Correspondence match;
    double squares = 0; //!< sum over the merged vertices of their squared distance, mm2
};

struct Choice
{
    const MergeInterface* a = nullptr;
    const MergeInterface* b = nullptr;
    std::vector<SeamChoice> seams;
    double score = 0;
    double distance = 0;
    double asymmetry = 0;
};

double squares(const Interface& a, const Interface& b, const Correspondence& match)
{
    double sum = 0;
    for (int i = 0; i < a.size(); ++i) {
        sum += (a.points[i] - b.points[partner(match, i, a.size())]).squaredNorm();
    }
    return sum;
}

//! The compatible correspondence whose vertices are closest as posed; every way to zip the larger loop is tried.
std::optional<SeamChoice> best_seam(const Interface& a, const Interface& b, const DefectRange& limits, int variants)
{
    std::optional<SeamChoice> best;
    const int size = std::min(a.size(), b.size());
    if (std::abs(a.size() - b.size()) > 2 * most_zips || size < 4) {
        return best;
    }
    for (const Interface& fixed : shortened(a, size, limits, variants)) {
        for (const Interface& moving : shortened(b, size, limits, variants)) {
            for (const Correspondence& match : correspondences(fixed, moving, limits)) {
                const double sum = squares(fixed, moving, match);
                if (!best || sum < best->squares) {
                    best = SeamChoice{0, 0, fixed, moving, match, sum};
                }
            }
        }
    }
    return best;
}

Vec3 loop_middle(const Interface& loop)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : loop.points) {
        sum += p;
    }
    return sum / loop.size();
}

//! Match each loop of a with the nearest loop of b that is still free.
std::optional<std::vector<SeamChoice>> match_loops(const Cut& a, const Cut& b, const DefectRange& limits, int variants)
{
    if (a.loops.size() != b.loops.size()) {
        return std::nullopt;
    }
    std::vector<char> taken(b.loops.size(), 0);
    std::vector<SeamChoice> result;
    for (std::size_t i = 0; i < a.loops.size(); ++i) {
        int nearest = -1;
        for (int j = 0; j < static_cast<int>(b.loops.size()); ++j) {
            const auto way = [&](int k) { return (loop_middle(a.loops[i]) - loop_middle(b.loops[k])).norm(); };
            if (!taken[j] && (nearest < 0 || way(j) < way(nearest))) {
                nearest = j;
            }
        }
        auto seam = best_seam(a.loops[i], b.loops[nearest], limits, variants);
        if (!seam) {
            return std::nullopt;
        }
        taken[nearest] = 1;
        seam->loop_a = static_cast<int>(i);
        seam->loop_b = nearest;
        result.push_back(std::move(*seam));
    }
    return result;
}

//! How far the merged vertices of a seam that meets the plane or axis are from being their own images.
double asymmetry(const std::vector<SeamChoice>& seams, const Symmetry& symmetry, double la)
{
    std::vector<Vec3> points;
    for (const SeamChoice& seam : seams) {
        for (int i = 0; i < seam.a.size(); ++i) {
            points.push_back((seam.a.points[i] + seam.b.points[partner(seam.match, i, seam.a.size())]) / 2);
        }
    }
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) {
        mean += p / static_cast<double>(points.size());
    }
    double worst = 0;
    for (const SymmetryImage& image : images(symmetry)) {
        if ((image.map * mean - mean).norm() > 0.6 * la) {
            continue;
        }
        double sum = 0;
        for (const Vec3& p : points) {
            double nearest = 1e300;
            for (const Vec3& q : points) {
                nearest = std::min(nearest, (image.map * p - q).squaredNorm());
            }
            sum += nearest;
        }
        worst = std::max(worst, std::sqrt(sum / static_cast<double>(points.size())));
    }
    return worst;
}

double min_defect(const Choice& choice)
{
    double least = 1e300;
    for (const SeamChoice& seam : choice.seams) {
        least = std::min(least, seam.match.min_defect);
    }
    return least;
}

double max_defect(const Choice& choice)
{
    double most = -1e300;
    for (const SeamChoice& seam : choice.seams) {
        most = std::max(most, seam.match.max_defect);
    }
    return most;
}

int zips(const Choice& choice)
{
    std::size_t count = 0;
    for (const SeamChoice& seam : choice.seams) {
        count += seam.a.zipped.size() + seam.b.zipped.size();
    }
    return static_cast<int>(count);
}

int loop_size(const Choice& choice)
{
    int size = 0;
    for (const SeamChoice& seam : choice.seams) {
        size += seam.a.size();
    }
    return size;
}

double off_union(const MergeInterface& a, const MergeInterface& b)
{
    return a.off_union + b.off_union;
}

void rate(Choice& choice, const Element& element, const Symmetry& symmetry)
{
    double sum = 0;
    for (const SeamChoice& seam : choice.seams) {
        sum += seam.squares;
    }
    choice.distance = std::sqrt(sum / loop_size(choice));
    choice.asymmetry = asymmetry(choice.seams, symmetry, element.la);
    const DefectRange limits = permissible_defect(element);
    const double margin = std::min(min_defect(choice) - limits.min, limits.max - max_defect(choice));
    choice.score = choice.distance / element.la + off_union_weight * off_union(*choice.a, *choice.b) / element.la +
                   zip_weight * zips(choice) + margin_weight * std::max(0.0, 1 - margin / comfortable_margin) +
                   asymmetry_weight * choice.asymmetry / element.la;
}

using Interfaces = std::vector<MergeInterface>;

std::vector<Choice> compatible_choices(const Interfaces& a, const Interfaces& b, const Element& element,
                                       const MergeOptions& options, int variants)
{
    std::vector<std::pair<const MergeInterface*, const MergeInterface*>> pairs;
    for (const MergeInterface& first : a) {
        for (const MergeInterface& second : b) {
            pairs.emplace_back(&first, &second);
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const auto& x, const auto& y) {
        return off_union(*x.first, *x.second) < off_union(*y.first, *y.second);
    });
    pairs.resize(std::min<std::size_t>(pairs.size(), pairs_tried));
    std::vector<Choice> result;
    std::vector<double> best; // scores so far, ascending
    for (const auto& [first, second] : pairs) {
        const double bound = off_union_weight * off_union(*first, *second) / element.la;
        if (static_cast<int>(best.size()) > choices_built && bound > best[choices_built]) {
            break; // the pairs that follow can only be worse
        }
        if (auto seams = match_loops(first->cut, second->cut, permissible_defect(element), variants)) {
            result.push_back({first, second, std::move(*seams)});
            rate(result.back(), element, options.symmetry);
            best.insert(std::upper_bound(best.begin(), best.end(), result.back().score), result.back().score);
        }
    }
    std::stable_sort(result.begin(), result.end(), [](const Choice& x, const Choice& y) {
        return std::lround(x.score * 1e6) < std::lround(y.score * 1e6);
    });
    return result;
}

MergeCandidate candidate(const Choice& choice, const Surface& a, const Surface& b)
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
    result.loop_size = loop_size(choice);
    result.zips = zips(choice);
    result.distance = choice.distance;
    result.off_union = off_union(*choice.a, *choice.b);
    result.min_defect = min_defect(choice);
    result.max_defect = max_defect(choice);
    result.asymmetry = choice.asymmetry;
    result.score = choice.score;
    result.change = graft({a, cut_a}, {b, cut_b}, seams, pose);
    return result;
}

//! Build the choices in order and keep those that are valid surfaces.
std::vector<MergeCandidate> valid_candidates(const std::vector<Choice>& choices, const Surface& a, const Surface& b,
                                             const Element& element, int count)
{
    std::vector<MergeCandidate> result;
    for (std::size_t i = 0; i < choices.size() && i < choices_built; ++i) {
        if (static_cast<int>(result.size()) == count) {
            break;
        }
        MergeCandidate made = candidate(choices[i], a, b);
        int unused = 1 << 30;
        const auto grafted = apply_grafts(a, {made.change}, unused);
        if (grafted && validate(grafted->surface, element).ok()) {
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

} // namespace

Expected<std::vector<MergeCandidate>> four_candidates(const Surface& a, const Surface& b, const Element& element,
                                                      const MergeOptions& options)
{
    const auto where = meeting(a, b, element);
    if (!where) {
        return tl::make_unexpected(where.error());
    }
    const Interfaces first = paper_interfaces(where->a, element);
    const Interfaces second = paper_interfaces(where->b, element);
    const auto choices = compatible_choices(first, second, element, options, 1);
    auto result = valid_candidates(choices, a, b, element, options.count);
    if (result.empty()) {
        return no_candidate(first, second, choices.size());
    }
    return result;
}

namespace {

Expected<std::vector<MergeCandidate>> search(const Meeting& where, const Element& element, const MergeOptions& options)
{
    const Interfaces first = nearby_interfaces(where.a, element, interfaces_tried, subsets_tried);
    const Interfaces second = nearby_interfaces(where.b, element, interfaces_tried, subsets_tried);
    const auto choices = compatible_choices(first, second, element, options, zip_variants);
    auto result = valid_candidates(choices, where.a.surface, where.b.surface, element, options.count);
    if (result.empty()) {
        return no_candidate(first, second, choices.size());
    }
    return result;
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

Expected<Merged> merge(const Surface& a, const Surface& b, const Element& element, int index,
                       const MergeOptions& options)
{
    MergeOptions enough = options;
    enough.count = std::max(options.count, index + 4);
    const auto candidates = merge_candidates(a, b, element, enough);
    if (!candidates) {
        return tl::make_unexpected(candidates.error());
    }
    std::optional<Merged> last;
    int found = 0;
    for (const MergeCandidate& chosen : *candidates) {
        int unused = 1 << 30;
        auto grafted = apply_grafts(a, {chosen.change}, unused);
        if (!grafted) {
            continue;
        }
        Merged result{std::move(grafted->surface), {}, chosen};
        result.embedding = embed_in_place(result.surface, a, grafted->number, element, options.embedding);
        const bool good = settled(result.embedding);
        if (good && found++ == index) {
            return result;
        }
        if (good || !last) {
            last = std::move(result);
        }
    }
    if (index == 0) {
        return std::move(*last);
    }
    return refuse("there is no candidate " + std::to_string(index) + ": the merge has " + std::to_string(found) +
                  ", numbered from 0");
}

} // namespace rhombloom
