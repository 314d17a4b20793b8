// This work is based on "Interactive Surface Design with Interlocking Elements" (Skouras, Coros, Grinspun,
// Thomaszewski 2015), Section 4.3.
#include "core/design/extrude.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/design/pose.h"
#include "core/model/layers.h"
#include "core/model/validity.h"

namespace rhombloom {

namespace {

constexpr int zip_variants = 16;    // ways to shorten a loop that are tried
constexpr int aligned_choices = 24; // correspondences of one pair of loops that are aligned and compared by their tips
constexpr int per_pair = 2;         // candidates of one pair of loops that are returned, so that others get a turn
constexpr int max_zips = 6;         // more mountains made one than this leave no sensible shape

//! A cut and how many layers lie on the side that counts: taken away (target) or kept (brush).
struct LayerCut
{
    Cut cut;
    int layers = 0;
    int elements = 0;
    std::vector<Vertex> tips = {}; //!< of a brush: the vertices whose middle is its tip
};

//! One pair of loops and a correspondence, still without geometry.
struct Choice
{
    const LayerCut* target = nullptr;
    const LayerCut* brush = nullptr;
    Interface target_loop;
    Interface brush_loop;
    Correspondence match;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    double tip_distance = 0;
    double misfit = 0;
    double asymmetry = 0;
};

long micro(double x)
{
    return std::lround(x * 1e6);
}

//! One cut per boundary between layers; \p keep_inner says which side stays.
std::vector<LayerCut> cuts_between(const Surface& surface, const Element& element, Vertex seed, bool keep_inner)
{
    std::vector<LayerCut> result;
    std::vector<char> kept(surface.n_faces(), keep_inner ? 0 : 1);
    int count = 0;
    int elements = 0;
    for (const std::vector<Face>& layer : layers(surface, seed)) {
        for (const Face f : layer) {
            kept[f.idx()] = keep_inner ? 1 : 0;
        }
        ++count;
        elements += static_cast<int>(layer.size());
        if (auto made = cut(surface, element, kept); made && made->loops.size() == 1) {
            result.push_back({std::move(*made), count, elements});
        }
    }
    return result;
}

std::vector<LayerCut> target_cuts(const Surface& target, const Element& element, Vertex apex)
{
    std::vector<LayerCut> result = cuts_between(target, element, apex, false);
    if (auto opened = opened_apex(target, element, apex)) {
        result.insert(result.begin(), {std::move(*opened), 0, 0});
    }
    return result;
}

//! Edges from the nearest of \p sources to each vertex; -1: out of reach.
std::vector<int> steps_from(const Surface& surface, std::vector<Vertex> sources)
{
    std::vector<int> steps(surface.n_vertices(), -1);
    for (const Vertex v : sources) {
        steps[v.idx()] = 0;
    }
    for (std::size_t i = 0; i < sources.size(); ++i) {
        for (const Vertex w : surface.vv_range(sources[i])) {
            if (steps[w.idx()] < 0) {
                steps[w.idx()] = steps[sources[i].idx()] + 1;
                sources.push_back(w);
            }
        }
    }
    return steps;
}

//! The interior vertex farthest from \p seed, in edges; among equals the farthest in space.
Vertex far_end(const Surface& surface, Vertex seed)
{
    const std::vector<int> steps = steps_from(surface, {seed});
    Vertex best;
    std::pair<int, double> farthest = {0, 0};
    for (const Vertex v : surface.vertices()) {
        const std::pair<int, double> here = {steps[v.idx()], (surface.point(v) - surface.point(seed)).norm()};
        if (!surface.is_boundary(v) && here > farthest) {
            farthest = here;
            best = v;
        }
    }
    return best;
}

//! A brush without an opening ends in its seed; any other in the vertices farthest from the loop it is glued by.
std::vector<Vertex> tips(const BaseShape& brush, const Cut& made)
{
    if (!brush.surface.is_boundary(brush.seed)) {
        return {brush.seed};
    }
    std::vector<Vertex> loop;
    for (const int v : made.loops[0].vertices) {
        loop.push_back(Vertex(v));
    }
    const std::vector<int> steps = steps_from(brush.surface, loop);
    const int farthest = *std::max_element(steps.begin(), steps.end());
    std::vector<Vertex> result;
    for (const Vertex v : brush.surface.vertices()) {
        if (steps[v.idx()] == farthest) {
            result.push_back(v);
        }
    }
    return result;
}

//! Ways to keep the whole brush: by one of its openings or, if it has none, opened at its far end.
std::vector<LayerCut> whole_brush_cuts(const BaseShape& brush, const Element& element, int layer_count)
{
    const int all = static_cast<int>(brush.surface.n_faces());
    std::vector<LayerCut> result;
    const Cut own = openings(brush.surface, element);
    for (const Interface& loop : own.loops) {
        Cut one;
        one.loops = {loop};
        result.push_back({std::move(one), layer_count, all});
    }
    if (const Vertex end = far_end(brush.surface, brush.seed); own.loops.empty() && end.is_valid()) {
        if (auto opened = opened_apex(brush.surface, element, end)) {
            result.push_back({std::move(*opened), layer_count + 1, all});
        }
    }
    return result;
}

std::vector<LayerCut> brush_cuts(const BaseShape& brush, const Element& element)
{
    std::vector<LayerCut> result;
    if (!brush.surface.is_boundary(brush.seed)) {
        result = cuts_between(brush.surface, element, brush.seed, true);
    }
    const int layer_count = static_cast<int>(layers(brush.surface, brush.seed).size());
    for (LayerCut& whole : whole_brush_cuts(brush, element, layer_count)) {
        result.push_back(std::move(whole));
    }
    for (LayerCut& made : result) {
        made.tips = tips(brush, made.cut);
    }
    return result;
}

int size_difference(const LayerCut& target, const LayerCut& brush)
{
    return std::abs(target.cut.loops[0].size() - brush.cut.loops[0].size());
}

//! All compatible correspondences of two loops, the larger one shortened in several ways.
void add_choices(const LayerCut& target, const LayerCut& brush, const DefectRange& limits, std::vector<Choice>& choices)
{
    const Interface& a = target.cut.loops[0];
    const Interface& b = brush.cut.loops[0];
    const int size = std::min(a.size(), b.size());
    for (const Interface& fixed : shortened(a, size, limits, zip_variants)) {
        for (const Interface& moving : shortened(b, size, limits, zip_variants)) {
            for (const Correspondence& match : correspondences(fixed, moving, limits)) {
                choices.push_back({&target, &brush, fixed, moving, match});
            }
        }
    }
}

using Pairs = std::vector<std::pair<const LayerCut*, const LayerCut*>>;

//! The pairs that add geometry, equal loops first.
Pairs pairs_by_difference(const std::vector<LayerCut>& targets, const std::vector<LayerCut>& brushes)
{
    Pairs pairs;
    for (const LayerCut& target : targets) {
        for (const LayerCut& brush : brushes) {
            if (brush.layers > target.layers && brush.elements > target.elements &&
                size_difference(target, brush) <= 2 * max_zips) {
                pairs.emplace_back(&target, &brush);
            }
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
        return size_difference(*a.first, *a.second) < size_difference(*b.first, *b.second);
    });
    return pairs;
}

//! How far the added vertices are from being their own images, when the apex is its own image.
double asymmetry(const Surface& target, const BaseShape& brush, const ExtrudeRequest& request,
                 const Eigen::Isometry3d& pose)
{
    double worst = 0;
    for (const SymmetryImage& image : images(request.symmetry)) {
        const Vec3 apex = target.point(request.apex);
        if ((image.map * apex - apex).norm() > 1e-2 * (request.drag.norm() + 1)) {
            continue;
        }
        double sum = 0;
        for (const Vertex v : brush.surface.vertices()) {
            const Vec3 p = image.map * (pose * brush.surface.point(v));
            double nearest = 1e300;
            for (const Vertex w : brush.surface.vertices()) {
                nearest = std::min(nearest, (pose * brush.surface.point(w) - p).squaredNorm());
            }
            sum += nearest;
        }
        worst = std::max(worst, std::sqrt(sum / static_cast<double>(brush.surface.n_vertices())));
    }
    return worst;
}

void place(Choice& choice, const Surface& target, const BaseShape& brush, const ExtrudeRequest& request)
{
    choice.pose = alignment(choice.target_loop, choice.brush_loop, choice.match);
    choice.misfit = misfit(choice.target_loop, choice.brush_loop, choice.match, choice.pose);
    const Vec3 tip = choice.pose * middle(brush.surface, choice.brush->tips);
    choice.tip_distance = (tip - target.point(request.apex) - request.drag).norm();
    choice.asymmetry = asymmetry(target, brush, request, choice.pose);
}

//! At most aligned_choices of each pair of loops; the order stays.
void keep_some_of_each_pair(std::vector<Choice>& choices)
{
    std::map<std::pair<const LayerCut*, const LayerCut*>, int> taken;
    std::erase_if(choices, [&](const Choice& c) { return ++taken[{c.target, c.brush}] > aligned_choices; });
}

//! Largest minimum defect first; only those are placed that can still win or stand in.
void rank(std::vector<Choice>& choices, const Surface& target, const Element& element, const BaseShape& brush,
          const ExtrudeRequest& request)
{
    std::stable_sort(choices.begin(), choices.end(), [](const Choice& a, const Choice& b) {
        return micro(a.match.min_defect) > micro(b.match.min_defect);
    });
    keep_some_of_each_pair(choices);
    for (Choice& choice : choices) {
        place(choice, target, brush, request);
    }
    const auto key = [&](const Choice& c) {
        const bool askew = c.asymmetry > 0.1 * element.la;
        return std::tuple(-micro(c.match.min_defect), askew, micro((c.tip_distance + c.misfit) / element.la));
    };
    std::stable_sort(choices.begin(), choices.end(), [&](const Choice& a, const Choice& b) { return key(a) < key(b); });
}

//! A few of each pair of loops, and none that a turn of the brush makes the same as one before it.
void keep_different(std::vector<Choice>& choices)
{
    std::map<std::pair<const LayerCut*, const LayerCut*>, int> taken;
    std::set<std::tuple<const LayerCut*, const LayerCut*, long, long, long, long>> seen;
    std::erase_if(choices, [&](const Choice& c) {
        const bool fresh = seen.emplace(c.target, c.brush, micro(c.match.min_defect), micro(c.match.max_defect),
                                        std::lround(c.tip_distance), std::lround(c.misfit))
                               .second;
        return !fresh || ++taken[{c.target, c.brush}] > per_pair;
    });
}

Surface fresh_brush(const BaseShape& brush, const ExtrudeRequest& request)
{
    Surface surface = brush.surface;
    surface.components = {request.component};
    for (const Face f : surface.faces()) {
        surface.data(f).serial = -1;
        surface.data(f).component = 0;
    }
    return surface;
}

ExtrudeCandidate candidate(const Choice& choice, const Surface& target, const Surface& brush)
{
    Cut target_cut = choice.target->cut;
    Cut brush_cut = choice.brush->cut;
    target_cut.loops = {choice.target_loop};
    brush_cut.loops = {choice.brush_loop};
    ExtrudeCandidate result;
    result.target_layers = choice.target->layers;
    result.brush_layers = choice.brush->layers;
    result.size_difference = size_difference(*choice.target, *choice.brush);
    result.min_defect = choice.match.min_defect;
    result.max_defect = choice.match.max_defect;
    result.tip_distance = choice.tip_distance;
    result.misfit = choice.misfit;
    result.asymmetry = choice.asymmetry;
    result.change =
        graft({target, target_cut}, {brush, brush_cut}, {{0, 0, choice.match}}, choice.pose, choice.brush->tips);
    return result;
}

tl::unexpected<Error> no_candidate(const Surface& target, const BaseShape& brush, Vertex apex, std::size_t pairs)
{
    const std::string where = "vertex " + std::to_string(apex.idx());
    if (target.is_boundary(apex) && pairs == 0) {
        return refuse(where + " lies on an opening: choose an apex inside the surface");
    }
    if (pairs == 0) {
        return refuse("no loop round " + where + " can take " + brush.name +
                      " and gain elements: choose a larger brush or another apex");
    }
    return refuse("none of the " + std::to_string(pairs) + " pairs of loops of " + brush.name + " and " + where +
                  " keeps the permissible defects: choose another brush or apex");
}

} // namespace

Expected<std::vector<ExtrudeCandidate>> extrude_candidates(const Surface& target, const Element& element,
                                                           const BaseShape& brush, const ExtrudeRequest& request,
                                                           int count)
{
    const std::vector<LayerCut> targets = target_cuts(target, element, request.apex);
    const std::vector<LayerCut> brushes = brush_cuts(brush, element);
    const Pairs pairs = pairs_by_difference(targets, brushes);
    const DefectRange limits = permissible_defect(element);
    const Surface added = fresh_brush(brush, request);
    std::vector<ExtrudeCandidate> result;
    for (std::size_t i = 0; i < pairs.size() && static_cast<int>(result.size()) < count;) {
        const int difference = size_difference(*pairs[i].first, *pairs[i].second);
        std::vector<Choice> group;
        for (; i < pairs.size() && size_difference(*pairs[i].first, *pairs[i].second) == difference; ++i) {
            add_choices(*pairs[i].first, *pairs[i].second, limits, group);
        }
        rank(group, target, element, brush, request);
        keep_different(group);
        for (std::size_t k = 0; k < group.size() && static_cast<int>(result.size()) < count; ++k) {
            result.push_back(candidate(group[k], target, added));
        }
    }
    if (result.empty()) {
        return no_candidate(target, brush, request.apex, pairs.size());
    }
    return result;
}

} // namespace rhombloom
