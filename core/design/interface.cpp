// This work is based on "Interactive Surface Design with Interlocking Elements" (Skouras, Coros, Grinspun,
// Thomaszewski 2015), Sections 4.1 and 4.3.
#include "core/design/interface.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <unordered_map>

namespace rhombloom {

namespace {

using Successors = std::unordered_map<int, int>; // loop vertex -> next loop vertex

Expected<Cut> loops_from(const std::vector<std::pair<int, int>>& steps)
{
    Successors next;
    for (const auto& [from, to] : steps) {
        if (!next.emplace(from, to).second) {
            return refuse("the loop touches itself at vertex " + std::to_string(from));
        }
    }
    Cut result;
    std::set<int> seen;
    for (const auto& [start, second] : steps) {
        if (seen.contains(start)) {
            continue;
        }
        Interface loop;
        int v = start;
        do {
            seen.insert(v);
            loop.vertices.push_back(v);
            const auto step = next.find(v);
            if (step == next.end()) {
                return refuse("the loop runs into an opening at vertex " + std::to_string(v));
            }
            v = step->second;
        } while (v != start && !seen.contains(v));
        if (v != start) {
            return refuse("the loop runs into an opening at vertex " + std::to_string(start));
        }
        result.loops.push_back(std::move(loop));
    }
    return result;
}

void measure_loop(const Surface& surface, const Element& element, const std::vector<char>& kept, Interface& loop)
{
    for (const int v : loop.vertices) {
        double angle = 0;
        int count = 0;
        for (const Face f : surface.vf_range(Vertex(v))) {
            if (kept[f.idx()]) {
                angle += corner_angle(surface, element, f, Vertex(v));
                ++count;
            }
        }
        loop.points.push_back(surface.point(Vertex(v)));
        loop.angles.push_back(angle);
        loop.elements.push_back(count);
    }
}

std::vector<std::pair<int, int>> cut_steps(const Surface& surface, const std::vector<char>& kept)
{
    std::vector<std::pair<int, int>> steps;
    for (const Face f : surface.faces()) {
        if (!kept[f.idx()]) {
            continue;
        }
        for (const Halfedge h : surface.fh_range(f)) {
            const Face other = surface.opposite_face_handle(h);
            if (other.is_valid() && !kept[other.idx()]) {
                steps.emplace_back(surface.from_vertex_handle(h).idx(), surface.to_vertex_handle(h).idx());
            }
        }
    }
    return steps;
}

Expected<void> check_opening(const Surface& surface, const Cut& result)
{
    for (const Interface& loop : result.loops) {
        for (const int v : loop.vertices) {
            if (surface.is_boundary(Vertex(v))) {
                return refuse("the loop runs into an opening at vertex " + std::to_string(v));
            }
        }
    }
    return {};
}

//! Close the valley at position \p i: its neighbours become one vertex.
Interface zip(const Interface& loop, int i)
{
    const int n = loop.size();
    const int a = (i + n - 1) % n;
    const int b = (i + 1) % n;
    Interface result;
    result.zipped = loop.zipped;
    result.zipped.emplace_back(loop.vertices[a], loop.vertices[b]);
    result.zipped_defect = std::min(loop.zipped_defect, two_pi - loop.angles[i]);
    for (int j = 0; j < n; ++j) {
        if (j == i || j == b) {
            continue;
        }
        const bool joined = j == a;
        result.vertices.push_back(loop.vertices[j]);
        result.points.push_back(joined ? Vec3((loop.points[a] + loop.points[b]) / 2) : loop.points[j]);
        result.angles.push_back(joined ? loop.angles[a] + loop.angles[b] : loop.angles[j]);
        result.elements.push_back(joined ? loop.elements[a] + loop.elements[b] : loop.elements[j]);
    }
    return result;
}

//! Largest resulting defect first; among equals, the loop whose fullest vertex has most room left.
std::pair<long, long> zip_order(const Interface& loop, int i)
{
    const int n = loop.size();
    const int a = (i + n - 1) % n;
    const int b = (i + 1) % n;
    double fullest = loop.angles[a] + loop.angles[b];
    for (int j = 0; j < n; ++j) {
        fullest = j == i ? fullest : std::max(fullest, loop.angles[j]);
    }
    const double defect = std::min(loop.zipped_defect, two_pi - loop.angles[i]);
    return {-std::lround(defect * 1e6), std::lround(fullest * 1e6)};
}

bool can_zip(const Interface& loop, int i, const DefectRange& limits)
{
    const double defect = two_pi - loop.angles[i];
    return loop.size() > 4 && loop.elements[i] >= 2 && defect >= limits.min - 1e-9 && defect <= limits.max + 1e-9;
}

} // namespace

bool is_mountain(const Interface& loop, int i)
{
    const int n = loop.size();
    return loop.elements[i] < loop.elements[(i + 1) % n] && loop.elements[i] < loop.elements[(i + n - 1) % n];
}

bool is_valley(const Interface& loop, int i)
{
    const int n = loop.size();
    return loop.elements[i] > loop.elements[(i + 1) % n] && loop.elements[i] > loop.elements[(i + n - 1) % n];
}

Expected<Cut> cut(const Surface& surface, const Element& element, const std::vector<char>& kept)
{
    expects(kept.size() == surface.n_faces(), "cut: one entry per element");
    const auto count = std::count_if(kept.begin(), kept.end(), [](char k) { return k != 0; });
    if (count == 0) {
        return refuse("nothing is left of the surface");
    }
    if (count == static_cast<long>(kept.size())) {
        return refuse("no element is taken away");
    }
    auto result = loops_from(cut_steps(surface, kept));
    if (!result) {
        return result;
    }
    if (auto ok = check_opening(surface, *result); !ok) {
        return tl::make_unexpected(ok.error());
    }
    for (Interface& loop : result->loops) {
        measure_loop(surface, element, kept, loop);
    }
    for (int f = 0; f < static_cast<int>(kept.size()); ++f) {
        if (!kept[f]) {
            result->removed.push_back(f);
        }
    }
    return result;
}

Expected<Cut> opened_apex(const Surface& surface, const Element& element, Vertex apex)
{
    if (surface.is_boundary(apex)) {
        return refuse("vertex " + std::to_string(apex.idx()) + " lies on an opening and cannot be opened");
    }
    Cut result;
    std::vector<std::pair<int, int>> steps;
    int copy = static_cast<int>(surface.n_vertices());
    for (const Halfedge h : surface.voh_range(apex)) {
        const int after = surface.to_vertex_handle(h).idx();
        const int before = surface.from_vertex_handle(surface.prev_halfedge_handle(h)).idx();
        Quad q = quad(surface, surface.face_handle(h));
        std::replace(q.begin(), q.end(), apex.idx(), copy);
        result.rewritten.emplace_back(surface.face_handle(h).idx(), q);
        result.copies.push_back(surface.point(apex));
        steps.emplace_back(before, copy);
        steps.emplace_back(copy, after);
        ++copy;
    }
    auto traced = loops_from(steps);
    if (!traced) {
        return traced;
    }
    result.loops = std::move(traced->loops);
    const std::vector<char> all(surface.n_faces(), 1);
    Interface& loop = result.loops.front();
    const auto numbers = loop.vertices;
    std::replace_if(
        loop.vertices.begin(), loop.vertices.end(), [&](int v) { return v >= static_cast<int>(surface.n_vertices()); },
        apex.idx());
    if (auto ok = check_opening(surface, result); !ok) {
        return tl::make_unexpected(ok.error());
    }
    measure_loop(surface, element, all, loop);
    loop.vertices = numbers;
    for (int i = 0; i < loop.size(); ++i) {
        if (numbers[i] < static_cast<int>(surface.n_vertices())) {
            continue;
        }
        const Face f(result.rewritten[numbers[i] - surface.n_vertices()].first);
        loop.angles[i] = corner_angle(surface, element, f, apex);
        loop.elements[i] = 1;
    }
    return result;
}

Cut openings(const Surface& surface, const Element& element)
{
    Cut result;
    const std::vector<char> all(surface.n_faces(), 1);
    std::vector<char> seen(surface.n_halfedges(), 0);
    for (const Halfedge start : surface.halfedges()) {
        if (!surface.is_boundary(start) || seen[start.idx()]) {
            continue;
        }
        Interface loop;
        for (Halfedge h = start; !seen[h.idx()]; h = surface.next_halfedge_handle(h)) {
            seen[h.idx()] = 1;
            loop.vertices.push_back(surface.to_vertex_handle(h).idx());
        }
        // Boundary half-edges run with the elements to their right.
        std::reverse(loop.vertices.begin(), loop.vertices.end());
        measure_loop(surface, element, all, loop);
        result.loops.push_back(std::move(loop));
    }
    return result;
}

std::vector<Interface> shortened(const Interface& loop, int size, const DefectRange& limits, int count)
{
    struct Zip
    {
        std::pair<long, long> order;
        int variant = 0;
        int valley = 0;
    };
    std::vector<Interface> variants = {loop};
    while (!variants.empty() && variants.front().size() > size) {
        std::vector<Zip> zips;
        for (int k = 0; k < static_cast<int>(variants.size()); ++k) {
            for (int i = 0; i < variants[k].size(); ++i) {
                if (can_zip(variants[k], i, limits)) {
                    zips.push_back({zip_order(variants[k], i), k, i});
                }
            }
        }
        std::stable_sort(zips.begin(), zips.end(), [](const Zip& a, const Zip& b) { return a.order < b.order; });
        zips.resize(std::min<std::size_t>(zips.size(), count));
        std::vector<Interface> next;
        std::transform(zips.begin(), zips.end(), std::back_inserter(next),
                       [&](const Zip& z) { return zip(variants[z.variant], z.valley); });
        variants = std::move(next);
    }
    return variants;
}

} // namespace rhombloom
