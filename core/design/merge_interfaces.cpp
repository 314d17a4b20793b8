#include "core/design/merge_interfaces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <queue>
#include <set>

#include "core/design/reference.h"

namespace rhombloom {

namespace {

//! Regions of elements that do not intersect are wholly inside or outside: one test each.
std::vector<char> outside_elements(const Surface& surface, const std::vector<char>& intersecting, const Surface& other)
{
    std::vector<char> outside(surface.n_faces(), 0);
    std::vector<char> seen = intersecting;
    for (const Face start : surface.faces()) {
        if (seen[start.idx()]) {
            continue;
        }
        std::vector<Face> region = {start};
        seen[start.idx()] = 1;
        for (std::size_t i = 0; i < region.size(); ++i) {
            for (const Face g : surface.ff_range(region[i])) {
                if (!seen[g.idx()]) {
                    seen[g.idx()] = 1;
                    region.push_back(g);
                }
            }
        }
        const bool out = winding_number(other, centre(surface, start)) < 0.5;
        for (const Face f : region) {
            outside[f.idx()] = out ? 1 : 0;
        }
    }
    return outside;
}

std::vector<Face> band_elements(const Surface& surface, const std::vector<char>& intersecting)
{
    std::set<Face> band;
    for (const Face f : surface.faces()) {
        if (!intersecting[f.idx()]) {
            continue;
        }
        band.insert(f);
        for (const Face g : surface.ff_range(f)) {
            band.insert(g);
        }
    }
    return {band.begin(), band.end()};
}

using Mask = std::vector<char>;

double off_union(const MeetingSide& side, const Mask& kept)
{
    double sum = 0;
    for (std::size_t i = 0; i < side.band.size(); ++i) {
        const bool outside = side.depth[i] > 0;
        if (outside != (kept[side.band[i].idx()] != 0)) {
            sum += std::abs(side.depth[i]);
        }
    }
    return sum;
}

void add_interface(const MeetingSide& side, const Element& element, const Mask& kept,
                   std::vector<MergeInterface>& result)
{
    if (auto made = cut(side.surface, element, kept)) {
        result.push_back({std::move(*made), off_union(side, kept)});
    }
}

//! Subsets of a list of costs in the order of their sum.
class CheapestSubsets
{
public:
    explicit CheapestSubsets(const std::vector<double>& sorted_costs) : costs_(sorted_costs) { queue_.push({0, {}}); }

    bool empty() const { return queue_.empty(); }

    //! Indices of the next cheapest subset, ascending.
    std::vector<int> next()
    {
        const Entry entry = queue_.top();
        queue_.pop();
        const std::vector<int>& subset = entry.second;
        const int last = subset.empty() ? -1 : subset.back();
        if (last + 1 < static_cast<int>(costs_.size())) {
            std::vector<int> longer = subset;
            longer.push_back(last + 1);
            queue_.push({entry.first + costs_[last + 1], longer});
            if (last >= 0) {
                std::vector<int> shifted = subset;
                shifted.back() = last + 1;
                queue_.push({entry.first - costs_[last] + costs_[last + 1], shifted});
            }
        }
        return subset;
    }

private:
    using Entry = std::pair<double, std::vector<int>>;
    std::vector<double> costs_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

//! Cheap test before a cut is made: at every vertex of the band the elements kept form one run, or all or none.
class RunTest
{
public:
    explicit RunTest(const MeetingSide& side) : side_(side)
    {
        std::set<Vertex> vertices;
        for (const Face f : side.band) {
            for (const Vertex v : side.surface.fv_range(f)) {
                vertices.insert(v);
            }
        }
        for (const Vertex v : vertices) {
            fans_.emplace_back();
            for (const Halfedge h : side.surface.voh_range(v)) {
                fans_.back().push_back(side.surface.face_handle(h).idx());
            }
        }
    }

    bool operator()(const Mask& kept) const
    {
        return std::all_of(fans_.begin(), fans_.end(), [&](const std::vector<int>& fan) {
            int changes = 0;
            for (std::size_t i = 0; i < fan.size(); ++i) {
                changes += is_kept(kept, fan[i]) != is_kept(kept, fan[(i + 1) % fan.size()]) ? 1 : 0;
            }
            return changes <= 2;
        });
    }

private:
    static bool is_kept(const Mask& kept, int f) { return f >= 0 && kept[f] != 0; }

    const MeetingSide& side_;
    std::vector<std::vector<int>> fans_;
};

} // namespace

MeetingSide merge_side(const Surface& surface, const std::vector<char>& intersecting, const Surface& other)
{
    MeetingSide side{
        surface, intersecting, outside_elements(surface, intersecting, other), band_elements(surface, intersecting), {},
        {}};
    for (const Face f : side.band) {
        side.choices.push_back({static_cast<int>(side.depth.size())});
        side.depth.push_back(signed_distance(other, centre(surface, f)));
    }
    return side;
}

bool tie_images(MeetingSide& side, const Element& element, const Symmetry& symmetry)
{
    std::vector<std::vector<int>> orbits;
    std::set<int> seen;
    for (int i = 0; i < static_cast<int>(side.band.size()); ++i) {
        if (seen.contains(i)) {
            continue;
        }
        std::set<int> orbit = {i};
        for (const SymmetryImage& image : images(symmetry)) {
            const auto f = image_face(side.surface, element, image, side.band[i]);
            const auto found = f ? std::find(side.band.begin(), side.band.end(), *f) : side.band.end();
            if (found == side.band.end()) {
                return false;
            }
            orbit.insert(static_cast<int>(found - side.band.begin()));
        }
        seen.insert(orbit.begin(), orbit.end());
        orbits.emplace_back(orbit.begin(), orbit.end());
    }
    side.choices = std::move(orbits);
    return true;
}

std::vector<MergeInterface> paper_interfaces(const MeetingSide& side, const Element& element)
{
    std::vector<MergeInterface> result;
    Mask kept = side.outside;
    add_interface(side, element, kept, result);
    for (const Face f : side.surface.faces()) {
        if (!side.intersecting[f.idx()]) {
            continue;
        }
        for (const Face g : side.surface.ff_range(f)) {
            kept[f.idx()] = kept[f.idx()] || side.outside[g.idx()];
        }
    }
    add_interface(side, element, kept, result);
    return result;
}

std::vector<MergeInterface> nearby_interfaces(const MeetingSide& side, const Element& element, int count, int tries)
{
    std::vector<std::vector<int>> order = side.choices;
    const auto cost = [&](const std::vector<int>& choice) {
        return std::accumulate(choice.begin(), choice.end(), 0.0,
                               [&](double sum, int i) { return sum + std::abs(side.depth[i]); });
    };
    std::stable_sort(order.begin(), order.end(), [&](const auto& x, const auto& y) { return cost(x) < cost(y); });
    std::vector<double> costs;
    std::transform(order.begin(), order.end(), std::back_inserter(costs), cost);
    Mask base = side.outside;
    for (std::size_t i = 0; i < side.band.size(); ++i) {
        base[side.band[i].idx()] = side.depth[i] > 0 ? 1 : 0;
    }
    std::vector<MergeInterface> result;
    CheapestSubsets subsets(costs);
    const RunTest runs(side);
    for (int t = 0; t < tries && !subsets.empty() && static_cast<int>(result.size()) < count; ++t) {
        Mask kept = base;
        for (const int choice : subsets.next()) {
            for (const int i : order[choice]) {
                char& face = kept[side.band[i].idx()];
                face = face ? 0 : 1;
            }
        }
        if (runs(kept)) {
            add_interface(side, element, kept, result);
        }
    }
    return result;
}

} // namespace rhombloom
