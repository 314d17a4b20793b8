#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "exporters/figure.h"

namespace rhombloom {

namespace {

//! A pixel's layers: (depth toward the eye, mm; index into the list of faces).
using Layers = std::vector<std::pair<double, int>>;

//! Closer layers touch, as the folded halves of elements round a vertex of valence two do, mm.
constexpr double touching = 1e-4;

//! Pixels of a wrongly hidden part that is worth drawing again.
constexpr int noticeable = 9;

//! All faces over a grid of pixels, every layer kept.
class LayeredRaster
{
public:
    LayeredRaster(const FigureScene& scene, const std::vector<Face>& faces)
    {
        Vec2 low = Vec2::Constant(1e300);
        Vec2 high = Vec2::Constant(-1e300);
        for (const Face f : faces) {
            for (const Vec2& p : outline_of(scene, f)) {
                low = low.cwiseMin(p);
                high = high.cwiseMax(p);
            }
        }
        size_ = std::clamp(60 + 2 * static_cast<int>(faces.size()), 80, 320);
        scale_ = size_ / std::max(1e-9, (high - low).maxCoeff());
        low_ = low;
        pixels_.resize(static_cast<std::size_t>(size_) * size_);
        for (int i = 0; i < static_cast<int>(faces.size()); ++i) {
            add(scene, faces[i], i);
        }
        for (Layers& layers : pixels_) {
            std::sort(layers.begin(), layers.end());
        }
    }

    const std::vector<Layers>& pixels() const { return pixels_; }

private:
    void add(const FigureScene& scene, Face f, int index)
    {
        const Quad q = quad(*scene.surface, f);
        std::array<Vec3, 4> p;
        for (int k = 0; k < 4; ++k) {
            const Vec3& x = scene.surface->point(Vertex(q[k]));
            const Vec2 at = (project(scene.camera, x) - low_) * scale_;
            p[k] = Vec3(at.x(), at.y(), depth(scene.camera, x));
        }
        add(p[0], p[1], p[2], index);
        add(p[0], p[2], p[3], index);
    }

    void add(const Vec3& a, const Vec3& b, const Vec3& c, int index)
    {
        const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
        if (area == 0) {
            return;
        }
        const auto low = [&](int i) { return std::max(0, static_cast<int>(std::min({a[i], b[i], c[i]}))); };
        const auto high = [&](int i) { return std::min(size_ - 1, static_cast<int>(std::max({a[i], b[i], c[i]}))); };
        for (int y = low(1); y <= high(1); ++y) {
            for (int x = low(0); x <= high(0); ++x) {
                const Vec2 p(x + 0.5, y + 0.5);
                const double v = ((p.x() - a.x()) * (c.y() - a.y()) - (p.y() - a.y()) * (c.x() - a.x())) / area;
                const double w = ((b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x())) / area;
                if (v >= 0 && w >= 0 && v + w <= 1) {
                    const double z = a.z() + v * (b.z() - a.z()) + w * (c.z() - a.z());
                    pixels_[y * size_ + x].emplace_back(z, index);
                }
            }
        }
    }

    int size_ = 0;
    double scale_ = 1;
    Vec2 low_ = Vec2::Zero();
    std::vector<Layers> pixels_;
};

//! [far][near] -> pixels that say so.
using Votes = std::vector<std::map<int, int>>;

//! Layer \p i lies behind the next layer that it does not touch, and behind what touches that one.
void vote(const Layers& layers, std::size_t i, Votes& votes)
{
    double next = 1e300;
    for (std::size_t j = i + 1; j < layers.size() && layers[j].first <= next + touching; ++j) {
        if (layers[j].first > layers[i].first + touching) {
            next = std::min(next, layers[j].first);
            if (layers[i].second != layers[j].second) {
                ++votes[layers[i].second][layers[j].second];
            }
        }
    }
}

Votes count_votes(const LayeredRaster& raster, std::size_t faces)
{
    Votes votes(faces);
    for (const Layers& layers : raster.pixels()) {
        for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
            vote(layers, i, votes);
        }
    }
    return votes;
}

//! Where faces only touch, the one seen from outside lies in front of the one seen from inside.
void vote_for_touching(const LayeredRaster& raster, const std::vector<char>& outside, Votes& votes)
{
    for (const Layers& layers : raster.pixels()) {
        for (std::size_t i = 1; i < layers.size(); ++i) {
            int far = layers[i - 1].second;
            int near = layers[i].second;
            if (layers[i].first > layers[i - 1].first + touching || outside[far] == outside[near]) {
                continue;
            }
            if (outside[far] != 0) {
                std::swap(far, near);
            }
            if (!votes[far].contains(near) && !votes[near].contains(far)) {
                votes[far][near] = 1;
            }
        }
    }
}

//! Keeps the stronger opinion of each pair.
Votes settle(const Votes& votes)
{
    Votes result(votes.size());
    for (int far = 0; far < static_cast<int>(votes.size()); ++far) {
        for (const auto& [near, count] : votes[far]) {
            const auto back = votes[near].find(far);
            const int against = back == votes[near].end() ? 0 : back->second;
            if (count > against || (count == against && far < near)) {
                result[far][near] = count - against + 1;
            }
        }
    }
    return result;
}

//! Topological sort; when a cycle is left, the face with the fewest votes against it goes first.
std::vector<int> sorted(const Votes& in_front, const std::vector<double>& depths)
{
    const auto n = static_cast<int>(in_front.size());
    std::vector<int> waiting(n, 0); // votes of the undrawn faces behind
    for (const auto& nearer : in_front) {
        for (const auto& [near, count] : nearer) {
            waiting[near] += count;
        }
    }
    using Entry = std::tuple<int, double, int>; // votes against, depth, face: the least first
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (int i = 0; i < n; ++i) {
        queue.emplace(waiting[i], depths[i], i);
    }
    std::vector<char> drawn(n, 0);
    std::vector<int> order;
    while (!queue.empty()) {
        const auto [votes, d, i] = queue.top();
        queue.pop();
        if (drawn[i] || votes != waiting[i]) {
            continue;
        }
        drawn[i] = 1;
        order.push_back(i);
        for (const auto& [near, count] : in_front[i]) {
            if (!drawn[near]) {
                waiting[near] -= count;
                queue.emplace(waiting[near], depths[near], near);
            }
        }
    }
    return order;
}

std::vector<int> ordered(const FigureScene& scene, const std::vector<Face>& faces, const LayeredRaster& raster)
{
    std::vector<double> depths;
    std::vector<char> outside;
    for (const Face f : faces) {
        depths.push_back(depth(scene.camera, element_centre(*scene.surface, f)));
        outside.push_back(from_outside(scene, f));
    }
    Votes votes = settle(count_votes(raster, faces.size()));
    vote_for_touching(raster, outside, votes);
    return sorted(votes, depths);
}

//! For each face, the faces that it hides wrongly when drawn in its place, and in how many pixels.
Votes wrongly_hidden(const LayeredRaster& raster, const std::vector<int>& place)
{
    Votes hidden(place.size());
    for (const Layers& layers : raster.pixels()) {
        const auto painted = std::max_element(layers.begin(), layers.end(), [&](const auto& a, const auto& b) {
            return place[a.second] < place[b.second];
        });
        if (painted != layers.end() && painted->first < layers.back().first - touching) {
            ++hidden[painted->second][layers.back().second];
        }
    }
    return hidden;
}

//! The part of a convex polygon where the linear function of its corners is not negative.
template <class Height>
Polygon cut(const Polygon& polygon, const Height& height)
{
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2& a = polygon[i];
        const Vec2& b = polygon[(i + 1) % polygon.size()];
        const double ha = height(a);
        const double hb = height(b);
        if (ha >= 0) {
            result.push_back(a);
        }
        if ((ha < 0) != (hb < 0)) {
            result.push_back(a + (b - a) * (ha / (ha - hb)));
        }
    }
    return result;
}

//! Half of a face on the paper: three corners with their depths.
using Half = std::array<Vec3, 3>;

std::array<Half, 2> halves(const FigureScene& scene, Face f)
{
    const Quad q = quad(*scene.surface, f);
    const auto corner = [&](int k) {
        const Vec3& x = scene.surface->point(Vertex(q[k]));
        const Vec2 at = project(scene.camera, x);
        return Vec3(at.x(), at.y(), depth(scene.camera, x));
    };
    return {Half{corner(0), corner(1), corner(2)}, Half{corner(0), corner(2), corner(3)}};
}

double turn(const Vec2& a, const Vec2& b, const Vec2& c)
{
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double depth_in(const Half& h, const Vec2& p)
{
    const Vec2 a = h[0].head<2>();
    const Vec2 b = h[1].head<2>();
    const Vec2 c = h[2].head<2>();
    const double area = turn(a, b, c);
    return (turn(p, b, c) * h[0].z() + turn(a, p, c) * h[1].z() + turn(a, b, p) * h[2].z()) / area;
}

//! Where \p near covers \p far on the paper and lies in front of it.
Polygon part_in_front(const Half& near, const Half& far)
{
    Polygon part = {near[0].head<2>(), near[1].head<2>(), near[2].head<2>()};
    const double sense = turn(far[0].head<2>(), far[1].head<2>(), far[2].head<2>());
    if (std::abs(sense) < 1e-6 || std::abs(turn(part[0], part[1], part[2])) < 1e-6) {
        return {};
    }
    for (int k = 0; k < 3; ++k) {
        const Vec2 a = far[k].head<2>();
        const Vec2 b = far[(k + 1) % 3].head<2>();
        part = cut(part, [&](const Vec2& p) { return sense > 0 ? turn(a, b, p) : -turn(a, b, p); });
    }
    return cut(part, [&](const Vec2& p) { return depth_in(near, p) - depth_in(far, p); });
}

Painted once_more(const FigureScene& scene, Face near, Face far)
{
    constexpr double smallest = 0.05; // square points
    Painted result{near, far, {}};
    for (const Half& n : halves(scene, near)) {
        for (const Half& f : halves(scene, far)) {
            Polygon part = part_in_front(n, f);
            if (part.size() > 2 && polygon_area(part) > smallest) {
                result.part.push_back(std::move(part));
            }
        }
    }
    return result;
}

} // namespace

std::vector<Face> painter_order(const FigureScene& scene, const std::vector<Face>& faces)
{
    std::vector<Face> result;
    if (!faces.empty()) {
        for (const int i : ordered(scene, faces, LayeredRaster(scene, faces))) {
            result.push_back(faces[i]);
        }
    }
    return result;
}

std::vector<Painted> painter_sequence(const FigureScene& scene, const std::vector<Face>& faces)
{
    if (faces.empty()) {
        return {};
    }
    const LayeredRaster raster(scene, faces);
    const std::vector<int> order = ordered(scene, faces, raster);
    std::vector<int> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        place[order[i]] = static_cast<int>(i);
    }
    const auto hidden = wrongly_hidden(raster, place);
    std::vector<Painted> result;
    for (const int i : order) {
        result.push_back({faces[i], Face(), {}});
        std::vector<int> again;
        for (const auto& [near, pixels] : hidden[i]) {
            if (pixels >= noticeable) {
                again.push_back(near);
            }
        }
        std::sort(again.begin(), again.end(), [&](int a, int b) { return place[a] < place[b]; });
        for (const int near : again) {
            Painted part = once_more(scene, faces[near], faces[i]);
            if (!part.part.empty()) {
                result.push_back(std::move(part));
            }
        }
    }
    return result;
}

} // namespace rhombloom
