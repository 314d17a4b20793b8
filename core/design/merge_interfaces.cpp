#include "core/design/merge_interfaces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <queue>
#include <set>

#include "core/design/band_cut.h"
#include "core/design/reference.h"
#include "core/model/regions.h"

namespace rhombloom {

namespace {

//! Regions of elements that do not intersect are wholly inside or outside: one test each.
std::vector<char> outside_elements(const Surface& surface, const std::vector<char>& intersecting, const Surface& other)
{
    std::vector<char> outside(surface.n_faces(), 0);
    for (const std::vector<Face>& region : connected_regions(surface, intersecting)) {
        const bool out = winding_number(other, centre(surface, region.front())) < 0.5;
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

//! What is outside the other surface, element by element of the band.
Mask nearest_to_union(const MeetingSide& side)
{
    Mask kept = side.outside;
    for (std::size_t i = 0; i < side.band.size(); ++i) {
        kept[side.band[i].idx()] = side.depth[i] > 0 ? 1 : 0;
    }
    return kept;
}

//! The side's choices, the cheapest first.
std::vector<BandChange> changes(const MeetingSide& side)
{
    std::vector<BandChange> result;
    for (const std::vector<int>& choice : side.choices) {
        BandChange& change = result.emplace_back();
        for (const int i : choice) {
            change.elements.push_back(side.band[i]);
            change.cost += std::abs(side.depth[i]);
        }
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const BandChange& a, const BandChange& b) { return a.cost < b.cost; });
    return result;
}

} // namespace

MeetingSide merge_side(const Surface& surface, const std::vector<char>& intersecting, const Surface& other)
{
    MeetingSide side{
        surface, intersecting, outside_elements(surface, intersecting, other), band_elements(surface, intersecting), {},
        {}};
    std::vector<Vec3> centres;
    for (const Face f : side.band) {
        side.choices.push_back({static_cast<int>(centres.size())});
        centres.push_back(centre(surface, f));
    }
    side.depth = signed_distances(other, centres);
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
    const auto add = [&](const Mask& kept) {
        if (auto made = cut(side.surface, element, kept)) {
            result.push_back({std::move(*made), off_union(side, kept)});
        }
    };
    Mask kept = side.outside;
    add(kept);
    for (const Face f : side.surface.faces()) {
        if (!side.intersecting[f.idx()]) {
            continue;
        }
        for (const Face g : side.surface.ff_range(f)) {
            kept[f.idx()] = kept[f.idx()] || side.outside[g.idx()];
        }
    }
    add(kept);
    return result;
}

std::vector<MergeInterface> nearby_interfaces(const MeetingSide& side, const Element& element, int count, int tries)
{
    BandCut band(side.surface, element, side.band, nearest_to_union(side));
    const std::vector<BandChange> single = changes(side);
    band.repair(single);
    std::vector<double> costs;
    std::transform(single.begin(), single.end(), std::back_inserter(costs), [](const BandChange& c) { return c.cost; });
    CheapestSubsets subsets(costs);
    std::vector<MergeInterface> result;
    for (int t = 0; t < tries && !subsets.empty() && static_cast<int>(result.size()) < count; ++t) {
        std::vector<Face> toggled;
        for (const int k : subsets.next()) {
            toggled.insert(toggled.end(), single[k].elements.begin(), single[k].elements.end());
        }
        if (!band.runs_after_toggling(toggled)) {
            continue;
        }
        band.toggle(toggled);
        if (auto made = band.cut()) {
            result.push_back({std::move(*made), off_union(side, band.kept())});
        }
        band.toggle(toggled);
    }
    return result;
}

} // namespace rhombloom
