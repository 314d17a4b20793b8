#include "core/design/band_cut.h"

#include <algorithm>

namespace rhombloom {

BandCut::BandCut(const Surface& surface, const Element& element, const std::vector<Face>& band, std::vector<char> kept)
    : surface_(surface), element_(element), kept_(std::move(kept)), fan_of_(surface.n_vertices(), -1),
      fans_of_(surface.n_faces())
{
    std::vector<char> in_band(surface.n_faces(), 0);
    for (const Face f : band) {
        in_band[f.idx()] = 1;
    }
    for (const Face f : band) {
        int k = 0;
        for (const Halfedge h : surface.fh_range(f)) {
            const int from = fan_number(surface.from_vertex_handle(h));
            const int to = fan_number(surface.to_vertex_handle(h));
            const Face other = surface.opposite_face_handle(h);
            fans_of_[f.idx()][k++] = from;
            if (other.is_valid()) {
                borders_.push_back({from, to, f.idx(), other.idx()});
            }
            if (other.is_valid() && !in_band[other.idx()]) {
                borders_.push_back({to, from, other.idx(), f.idx()});
            }
        }
    }
    broken_ =
        static_cast<int>(std::count_if(fans_.begin(), fans_.end(), [&](const Fan& fan) { return is_broken(fan); }));
}

int BandCut::fan_number(Vertex v)
{
    int& number = fan_of_[v.idx()];
    if (number < 0) {
        number = static_cast<int>(fans_.size());
        Fan& fan = fans_.emplace_back();
        fan.vertex = v.idx();
        fan.open = surface_.is_boundary(v);
        for (const Halfedge h : surface_.voh_range(v)) {
            const Face f = surface_.face_handle(h);
            fan.elements.push_back(f.idx());
            fan.angles.push_back(f.is_valid() ? corner_angle(surface_, element_, f, v) : 0);
        }
    }
    return number;
}

bool BandCut::is_broken(const Fan& fan) const
{
    int changes = 0;
    bool before = is_kept(fan.elements.back());
    for (const int f : fan.elements) {
        const bool now = is_kept(f);
        changes += now != before ? 1 : 0;
        before = now;
    }
    return changes > 2;
}

void BandCut::flip(const std::vector<Face>& elements)
{
    for (const Face f : elements) {
        kept_[f.idx()] = kept_[f.idx()] ? 0 : 1;
    }
}

bool BandCut::runs_after_toggling(const std::vector<Face>& elements)
{
    std::vector<int> touched;
    for (const Face f : elements) {
        touched.insert(touched.end(), fans_of_[f.idx()].begin(), fans_of_[f.idx()].end());
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    const auto broken = [&](int fan) { return is_broken(fans_[fan]); };
    if (broken_ > std::count_if(touched.begin(), touched.end(), broken)) {
        return false;
    }
    flip(elements);
    const bool runs = std::none_of(touched.begin(), touched.end(), broken);
    flip(elements);
    return runs;
}

void BandCut::toggle(const std::vector<Face>& elements)
{
    for (const Face f : elements) {
        broken_ -= broken_round(f);
        flip({f});
        broken_ += broken_round(f);
    }
}

int BandCut::broken_round(Face f) const
{
    const auto& round = fans_of_[f.idx()];
    return static_cast<int>(std::count_if(round.begin(), round.end(), [&](int fan) { return is_broken(fans_[fan]); }));
}

void BandCut::repair(const std::vector<BandChange>& groups)
{
    for (std::size_t k = 0; k < groups.size() && broken_ > 0; ++k) {
        const BandChange* best = nullptr;
        double best_rate = 1e300;
        for (const BandChange& group : groups) {
            const int before = broken_;
            toggle(group.elements);
            const int gain = before - broken_;
            toggle(group.elements);
            if (gain > 0 && group.cost / gain < best_rate) {
                best_rate = group.cost / gain;
                best = &group;
            }
        }
        if (best == nullptr) {
            return;
        }
        toggle(best->elements);
    }
}

void BandCut::measure(const Fan& fan, Interface& loop) const
{
    double angle = 0;
    int count = 0;
    for (std::size_t k = 0; k < fan.elements.size(); ++k) {
        if (is_kept(fan.elements[k])) {
            angle += fan.angles[k];
            ++count;
        }
    }
    loop.vertices.push_back(fan.vertex);
    loop.points.push_back(surface_.point(Vertex(fan.vertex)));
    loop.angles.push_back(angle);
    loop.elements.push_back(count);
}

std::optional<Cut> BandCut::cut() const
{
    std::vector<int> next(fans_.size(), -1);
    for (const Border& border : borders_) {
        if (kept_[border.left] && !kept_[border.right]) {
            if (fans_[border.from].open || fans_[border.to].open) {
                return std::nullopt;
            }
            next[border.from] = border.to;
        }
    }
    Cut result;
    for (std::size_t start = 0; start < next.size(); ++start) {
        if (next[start] < 0) {
            continue;
        }
        Interface& loop = result.loops.emplace_back();
        for (int fan = static_cast<int>(start); next[fan] >= 0;) {
            measure(fans_[fan], loop);
            fan = std::exchange(next[fan], -1);
        }
    }
    if (result.loops.empty()) {
        return std::nullopt;
    }
    for (int f = 0; f < static_cast<int>(kept_.size()); ++f) {
        if (!kept_[f]) {
            result.removed.push_back(f);
        }
    }
    return result;
}

} // namespace rhombloom
