#include <algorithm>
#include <cmath>

#include "core/building/orders.h"
#include "core/building/viewpoints.h"

// This follows Sec. 5 of the paper: first modelled, first built; spiralling through the layers; components with
// their junctions in sequence; closed shapes are closed, and reopened where the next component joins.

namespace rhombloom {

namespace {

//! Elements of a batch in layers: the first are those round the seed, or those that touch what is built.
std::vector<std::vector<int>> batch_layers(const Target& target, const std::vector<int>& batch,
                                           const std::vector<int>& first)
{
    std::vector<std::vector<int>> result = {first};
    std::vector<char> taken(target.face.size(), 1);
    for (const int e : batch) {
        taken[e] = 0;
    }
    for (const int e : first) {
        taken[e] = 1;
    }
    while (!result.back().empty()) {
        std::vector<int> next;
        for (const int e : result.back()) {
            for (const Port& port : target.ports[e]) {
                if (port.element >= 0 && !taken[port.element]) {
                    taken[port.element] = 1;
                    next.push_back(port.element);
                }
            }
        }
        std::sort(next.begin(), next.end());
        result.push_back(std::move(next));
    }
    result.pop_back();
    return result;
}

//! The ring round the lowest vertex of the batch: there the spiral upwards starts.
std::vector<int> seed_ring(const Surface& surface, const Target& target, const std::vector<int>& batch)
{
    std::vector<int> element_of(surface.n_faces(), -1);
    Vertex seed;
    for (const int e : batch) {
        element_of[target.face[e]] = e;
        for (const Vertex v : surface.fv_range(Face(target.face[e]))) {
            const bool lower = !seed.is_valid() || surface.point(v).z() < surface.point(seed).z() - 1e-6;
            seed = lower ? v : seed;
        }
    }
    std::vector<int> ring;
    for (const Face f : surface.vf_range(seed)) {
        if (element_of[f.idx()] >= 0) {
            ring.push_back(element_of[f.idx()]);
        }
    }
    std::sort(ring.begin(), ring.end());
    return ring;
}

//! The angle of each element of a layer about the layer's axis, counter-clockwise seen from outside, 0..2 pi.
class Turning
{
public:
    Turning(const Surface& surface, const Target& target, const std::vector<int>& layer)
        : surface_(surface), target_(target)
    {
        Vec3 axis = Vec3::Zero();
        for (const int e : layer) {
            centre_ += element_centre(surface, face(e)) / static_cast<double>(layer.size());
            axis += element_normal(surface, face(e));
        }
        axis = axis.norm() > 1e-6 ? Vec3(axis.normalized()) : Vec3(Vec3::UnitZ());
        x_ = axis.unitOrthogonal();
        y_ = axis.cross(x_);
    }

    double from(int last, int e) const
    {
        const double turn = angle(e) - angle(last);
        return turn <= 1e-9 ? turn + two_pi : turn;
    }

private:
    Face face(int e) const { return Face(target_.face[e]); }

    double angle(int e) const
    {
        const Vec3 arm = element_centre(surface_, face(e)) - centre_;
        return std::atan2(arm.dot(y_), arm.dot(x_));
    }

    const Surface& surface_;
    const Target& target_;
    Vec3 centre_ = Vec3::Zero();
    Vec3 x_ = Vec3::UnitX();
    Vec3 y_ = Vec3::UnitY();
};

int shared_corners(const Surface& surface, const Target& target, int a, int b)
{
    if (a < 0 || target.face[a] < 0) {
        return 0;
    }
    const Quad p = quad(surface, Face(target.face[a]));
    const Quad q = quad(surface, Face(target.face[b]));
    return static_cast<int>(
        std::count_if(p.begin(), p.end(), [&](int v) { return std::count(q.begin(), q.end(), v); }));
}

struct Spiral
{
    const Surface& surface;
    const BuildHistory& history;
    const Target& target;
    BuildState& state;
};

enum class Care
{
    KeepEasyPlugs, //!< rather leave elements for later than spoil the last plug
    None
};

//! The next element of the layer: beside the last one, going on in the same sense.
int next_in_layer(const Spiral& s, const std::vector<int>& layer, const Turning& turning, Care care)
{
    int best = -1;
    double best_key = 1e300;
    for (const int e : layer) {
        const bool loose = missing_joins(s.state, s.target, e).empty() && s.state.last >= 0;
        if (s.state.present[e] || loose || (care == Care::KeepEasyPlugs && !leaves_easy_plugs(s.state, s.target, e))) {
            continue;
        }
        const bool near = shared_corners(s.surface, s.target, s.state.last, e) > 0;
        const bool placed = s.state.last >= 0 && s.target.has(s.state.last);
        const double key = (near ? 0 : 100) + (placed ? turning.from(s.state.last, e) : 0);
        if (key < best_key - 1e-9) {
            best_key = key;
            best = e;
        }
    }
    return best;
}

void build_layer(const Spiral& s, const std::vector<int>& layer, Care care)
{
    const Turning turning(s.surface, s.target, layer);
    for (int e = next_in_layer(s, layer, turning, care); e >= 0; e = next_in_layer(s, layer, turning, care)) {
        insert(s.state, s.history, s.target, e);
    }
}

void build_batch(const Spiral& s, const std::vector<int>& batch)
{
    std::vector<int> first;
    for (const int e : batch) {
        if (!missing_joins(s.state, s.target, e).empty()) {
            first.push_back(e);
        }
    }
    if (first.empty()) {
        first = seed_ring(s.surface, s.target, batch);
        insert(s.state, s.history, s.target, first.front());
    }
    for (const auto& layer : batch_layers(s.target, batch, first)) {
        build_layer(s, layer, Care::KeepEasyPlugs);
    }
    build_layer(s, batch, Care::KeepEasyPlugs);
    build_layer(s, batch, Care::None);
}

} // namespace

std::vector<Step> paper_order(const PlanSources& sources)
{
    const BuildHistory& history = sources.history;
    BuildState state = empty_state(history);
    for (const Target& target : history.targets) {
        reopen(state, target, chapter_of(state, history, target));
        const Spiral spiral{stage_surface(sources.replay, target.stage), history, target, state};
        for (auto waiting = batches(state, history, target); !waiting.empty();
             waiting = batches(state, history, target)) {
            build_batch(spiral, waiting[next_batch(state, history, target, waiting)]);
        }
    }
    return std::move(state.steps);
}

} // namespace rhombloom
