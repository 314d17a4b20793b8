#include "core/design/mesh_import/network_patch.h"

#include <algorithm>
#include <deque>
#include <map>

#include "core/form/embedding_terms.h"
#include "core/form/minimise.h"
#include "core/form/settle.h"
#include "core/model/element_stretch.h"

namespace rhombloom {

namespace {

constexpr int reach = 4; // edges from the place to the last corners that have all their triangles
constexpr double tolerance = 1e-4;
constexpr int most_iterations = 400;
constexpr int most_newton_iterations = 60; // of these, and as many without guards: what comes to rest takes about 14

using Neighbours = std::vector<std::vector<int>>;

Neighbours neighbours(const TriangleMesh& mesh)
{
    Neighbours result(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            result[t[k]].push_back(t[(k + 1) % 3]);
            result[t[k]].push_back(t[(k + 2) % 3]);
        }
    }
    return result;
}

//! Edges from the nearest of the starts, up to \p most; -1 beyond.
std::vector<int> distances(const Neighbours& near, const std::vector<int>& starts, int most)
{
    std::vector<int> result(near.size(), -1);
    std::deque<int> open(starts.begin(), starts.end());
    for (const int v : starts) {
        result[v] = 0;
    }
    for (; !open.empty(); open.pop_front()) {
        const int v = open.front();
        for (const int w : near[v]) {
            if (result[w] < 0 && result[v] < most) {
                result[w] = result[v] + 1;
                open.push_back(w);
            }
        }
    }
    return result;
}

//! Corners on the rim of an open mesh, each as often as the rim passes it.
std::vector<int> rim(const std::vector<Triangle>& triangles)
{
    std::set<Corners> edges;
    for (const Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            edges.emplace(t[k], t[(k + 1) % 3]);
        }
    }
    std::vector<int> result;
    for (const auto& [a, b] : edges) {
        if (edges.count({b, a}) == 0) {
            result.push_back(a);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

//! Corners where the chosen triangles touch in a point only.
std::vector<int> pinches(const TriangleMesh& mesh, const std::vector<bool>& chosen)
{
    std::vector<Triangle> part;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (chosen[i]) {
            part.push_back(mesh.triangles[i]);
        }
    }
    const std::vector<int> passed = rim(part);
    std::vector<int> result;
    for (auto v = passed.begin(); v != passed.end() && (v = std::adjacent_find(v, passed.end())) != passed.end(); ++v) {
        result.push_back(*v);
    }
    return result;
}

//! The triangles with a corner within reach, and those that close pinches.
std::vector<bool> triangles_near(const TriangleMesh& mesh, const std::vector<int>& starts)
{
    const std::vector<int> distance = distances(neighbours(mesh), starts, reach);
    std::vector<bool> is_near(mesh.points.size());
    std::transform(distance.begin(), distance.end(), is_near.begin(), [](int d) { return d >= 0; });
    std::vector<bool> chosen(mesh.triangles.size());
    const auto choose = [&] {
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            const Triangle& t = mesh.triangles[i];
            chosen[i] = std::any_of(t.begin(), t.end(), [&](int v) { return is_near[v]; });
        }
    };
    choose();
    for (std::vector<int> more = pinches(mesh, chosen); !more.empty(); more = pinches(mesh, chosen)) {
        for (const int v : more) {
            is_near[v] = true;
        }
        choose();
    }
    return chosen;
}

//! The corners of \p place and of the triangles at it.
std::vector<int> corners_at(const TriangleMesh& mesh, const Corners& place)
{
    std::set<int> result;
    for (const Triangle& t : mesh.triangles) {
        const auto has = [&](int v) { return std::find(t.begin(), t.end(), v) != t.end(); };
        if (has(place.first) && has(place.second)) {
            result.insert(t.begin(), t.end());
        }
    }
    return {result.begin(), result.end()};
}

//! Edges from the rim to each corner, 3 for more.
std::vector<int> depths(const TriangleMesh& mesh)
{
    std::vector<int> result = distances(neighbours(mesh), rim(mesh.triangles), 2);
    std::replace(result.begin(), result.end(), -1, 3);
    return result;
}

//! Which vertices of the join may move: corners two edges from the rim, middles of triangles away from it.
std::vector<bool> free_vertices(const TriangleMesh& mesh, const std::vector<int>& depth)
{
    std::vector<bool> result;
    for (const int d : depth) {
        result.push_back(d >= 2);
    }
    for (const Triangle& t : mesh.triangles) {
        result.push_back(std::all_of(t.begin(), t.end(), [&](int v) { return depth[v] >= 1; }));
    }
    return result;
}

//! The same energy with the free vertices first and the others held.
EmbeddingTerms with_held(EmbeddingTerms terms, const std::vector<bool>& is_free, std::vector<int>& number)
{
    number.assign(is_free.size(), -1);
    int next = 0;
    for (const bool want : {true, false}) {
        for (std::size_t v = 0; v < is_free.size(); ++v) {
            if (is_free[v] == want) {
                number[v] = next++;
            }
        }
        terms.free_count = want ? next : terms.free_count;
    }
    for (SpringPair& pair : terms.springs) {
        pair.a = number[pair.a];
        pair.b = number[pair.b];
    }
    for (HingeVertices& hinge : terms.hinges) {
        std::transform(hinge.begin(), hinge.end(), hinge.begin(), [&](int v) { return number[v]; });
    }
    return terms;
}

//! Bring the free vertices to rest; the iterations it took, none when it did not. \p may_keep_guards: where there is no
//! rest without them.
std::optional<int> settle_free(Surface& surface, const std::vector<bool>& is_free, const Trials& trials,
                               bool may_keep_guards)
{
    const double la = trials.element.la;
    std::vector<int> number;
    EmbeddingTerms terms =
        with_held(embedding_terms(surface, trials.element, trials.options.embedding), is_free, number);
    Eigen::VectorXd x(3 * number.size());
    for (const Vertex v : surface.vertices()) {
        x.segment<3>(3 * number[v.idx()]) = surface.point(v) / la;
    }
    Iterate iterate = iterate_at(terms, std::move(x));
    MinimiseOptions options;
    options.tolerance = tolerance;
    options.max_iterations = most_iterations;
    options.max_newton_iterations = most_newton_iterations;
    MinimiseResult result = minimise(terms, iterate, options);
    if (result.reason == StopReason::Converged && embedding_energy(terms, iterate.x).guard > 0) {
        remove_guards(terms); // they only help on the way
        Iterate pure = iterate_at(terms, iterate.x);
        options.max_iterations = most_newton_iterations;
        const MinimiseResult without = newton(terms, pure, options);
        result.iterations += without.iterations;
        if (without.reason == StopReason::Converged || !may_keep_guards) {
            result.reason = without.reason;
            iterate = std::move(pure);
        }
    }
    if (result.reason != StopReason::Converged) {
        return std::nullopt;
    }
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, la * iterate.x.segment<3>(3 * number[v.idx()]));
    }
    return result.iterations;
}

//! What the elements of the patch that are not held come to.
void rate(Patch& patch, const Surface& surface, const Trial& whole, const Trials& trials, double price)
{
    const std::vector<int> depth = depths(patch.plan.triangles);
    const std::vector<bool> is_free = free_vertices(patch.plan.triangles, depth);
    const double scale = whole.plan.scale;
    patch.badness = 0;
    patch.stretch = -1;
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        if (std::none_of(q.begin(), q.end(), [&](int v) { return is_free[v]; })) {
            continue;
        }
        Vec3 sum = Vec3::Zero();
        for (const int v : q) {
            sum += surface.point(Vertex(v));
        }
        const double distance = trials.target.nearest(scale * sum / 4).distance / scale / trials.element.la;
        const double stretch = element_stretch(surface, trials.element, f);
        patch.badness += price * excess_stretch(stretch) +
                         distance * distance / (2 * whole.rms * static_cast<double>(whole.ratings.size()));
        if (stretch > patch.stretch && depth[q[0]] >= 3 && depth[q[2]] >= 3) {
            patch.stretch = stretch;
            patch.worst = std::minmax(q[0], q[2]);
        }
    }
}

void take_points(const Surface& surface, Plan& plan)
{
    const std::size_t corners = plan.triangles.points.size();
    for (const Vertex v : surface.vertices()) {
        const auto k = static_cast<std::size_t>(v.idx());
        (k < corners ? plan.triangles.points[k] : plan.middles[k - corners]) = surface.point(v);
    }
}

//! The same network, wherever it is?
bool is_same(const Plan& a, const Plan& b)
{
    return a.triangles.triangles == b.triangles.triangles && a.flipped == b.flipped;
}

} // namespace

Patch patch_around(const Trial& whole, const Corners& place, const Trials& trials, double price)
{
    const TriangleMesh& mesh = whole.plan.triangles;
    const std::vector<bool> chosen = triangles_near(mesh, corners_at(mesh, place));
    Patch patch;
    std::map<int, int> number;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (!chosen[i]) {
            continue;
        }
        patch.triangles.push_back(static_cast<int>(i));
        Triangle t = mesh.triangles[i];
        for (int& v : t) {
            const auto [found, is_new] = number.emplace(v, static_cast<int>(number.size()));
            if (is_new) {
                patch.plan.triangles.points.push_back(mesh.points[v] / whole.plan.scale);
                patch.plan.origin.push_back(v);
            }
            v = found->second;
        }
        patch.plan.triangles.triangles.push_back(t);
        patch.plan.middles.push_back(whole.plan.middles[i] / whole.plan.scale);
    }
    for (const auto& [a, b] : whole.plan.flipped) {
        if (number.count(a) > 0 && number.count(b) > 0) {
            patch.plan.flipped.insert(std::minmax(number[a], number[b]));
        }
    }
    if (const auto surface = surface_of(patch.plan)) {
        rate(patch, *surface, whole, trials, price);
    }
    return patch;
}

std::optional<Patch> changed(const Patch& patch, const Move& move, const Trial& whole, const Trials& trials,
                             double price)
{
    Patch result;
    result.plan = carry_out({move}, patch.plan);
    if (move.kind != Move::Kind::Pop && is_same(result.plan, patch.plan)) {
        return std::nullopt;
    }
    result.triangles = patch.triangles;
    auto surface = surface_of(result.plan);
    if (!surface || !has_permissible_defects(*surface, trials.element)) {
        return std::nullopt;
    }
    const TriangleMesh& mesh = result.plan.triangles;
    const bool is_guarded = whole.found.embedding.guard_energy > 0;
    const auto iterations = settle_free(*surface, free_vertices(mesh, depths(mesh)), trials, is_guarded);
    if (!iterations) {
        return std::nullopt;
    }
    result.iterations = *iterations;
    take_points(*surface, result.plan);
    rate(result, *surface, whole, trials, price);
    return result;
}

} // namespace rhombloom
