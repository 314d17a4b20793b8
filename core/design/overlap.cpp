#include "core/design/overlap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

namespace rhombloom {

namespace {

using Box = Eigen::AlignedBox3d;
using Segment = std::pair<Vec3, Vec3>;

double segment_distance(const Segment& a, const Segment& b)
{
    const Vec3 u = a.second - a.first;
    const Vec3 v = b.second - b.first;
    const Vec3 w = a.first - b.first;
    const double uu = u.squaredNorm();
    const double vv = v.squaredNorm();
    const double uv = u.dot(v);
    const double uw = u.dot(w);
    const double vw = v.dot(w);
    const double det = uu * vv - uv * uv;
    // Parallel segments: any s will do, the clamping below finds the overlap.
    double s = det > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / det, 0.0, 1.0) : 0.0;
    const double t = vv > 0 ? std::clamp((uv * s + vw) / vv, 0.0, 1.0) : 0.0;
    s = uu > 0 ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0.0;
    return (w + s * u - t * v).norm();
}

double point_segment_distance(const Vec3& p, const Segment& s)
{
    const Vec3 u = s.second - s.first;
    const double t = u.squaredNorm() > 0 ? std::clamp((p - s.first).dot(u) / u.squaredNorm(), 0.0, 1.0) : 0.0;
    return (p - s.first - t * u).norm();
}

Segment edge(const Triangle& t, int k)
{
    return {t[k], t[(k + 1) % 3]};
}

//! Does the segment go through the triangle's inside?
bool pierces(const Segment& s, const Triangle& t)
{
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    const double from = n.dot(s.first - t[0]);
    const double to = n.dot(s.second - t[0]);
    if (from * to >= 0) {
        return false;
    }
    const Vec3 p = s.first + from / (from - to) * (s.second - s.first);
    for (int k = 0; k < 3; ++k) {
        if (n.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) < 0) {
            return false;
        }
    }
    return true;
}

bool cross(const Triangle& a, const Triangle& b)
{
    for (int k = 0; k < 3; ++k) {
        if (pierces(edge(a, k), b) || pierces(edge(b, k), a)) {
            return true;
        }
    }
    return false;
}

Box bounds(const Surface& surface, Face f)
{
    Box box;
    for (const Vertex v : surface.fv_range(f)) {
        box.extend(surface.point(v));
    }
    return box;
}

std::vector<Box> all_bounds(const Surface& surface)
{
    std::vector<Box> boxes;
    for (const Face f : surface.faces()) {
        boxes.push_back(bounds(surface, f));
    }
    return boxes;
}

//! A surface prepared for many questions.
struct Prepared
{
    explicit Prepared(const Surface& surface) : boxes(all_bounds(surface))
    {
        for (const Face f : surface.faces()) {
            elements.push_back(triangles(surface, f));
        }
    }

    std::vector<Box> boxes; //!< one per element
    std::vector<std::array<Triangle, 2>> elements;
};

bool close(const std::array<Triangle, 2>& a, const std::array<Triangle, 2>& b, double touching)
{
    return std::any_of(a.begin(), a.end(), [&](const Triangle& s) {
        return std::any_of(b.begin(), b.end(), [&](const Triangle& t) { return distance(s, t) <= touching; });
    });
}

//! Adds up angles between -pi and pi, given as complex numbers, without an arc tangent for each.
class AngleSum
{
public:
    void add(double re, double im)
    {
        const double x = x_ * re - y_ * im;
        const double y = x_ * im + y_ * re;
        turns_ += (y_ > 0 && im > 0 && y < 0) ? 1 : (y_ < 0 && im < 0 && y > 0) ? -1 : 0;
        const double size = std::max(std::abs(x), std::abs(y));
        if (size > 0) {
            x_ = x / size;
            y_ = y / size;
        }
    }

    double value() const { return std::atan2(y_, x_) + turns_ * two_pi; }

private:
    double x_ = 1;
    double y_ = 0;
    int turns_ = 0;
};

//! Half the solid angle of a triangle (Van Oosterom and Strackee 1983).
void add_half_solid_angle(const Triangle& t, const Vec3& p, AngleSum& sum)
{
    const Vec3 a = t[0] - p;
    const Vec3 b = t[1] - p;
    const Vec3 c = t[2] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum.add(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb, a.dot(b.cross(c)));
}

double winding_number(const Prepared& surface, const Vec3& p)
{
    AngleSum sum;
    for (const auto& element : surface.elements) {
        for (const Triangle& t : element) {
            add_half_solid_angle(t, p, sum);
        }
    }
    return sum.value() / two_pi;
}

double distance(const Vec3& p, const std::array<Triangle, 2>& element)
{
    return std::min(rhombloom::distance(p, element[0]), rhombloom::distance(p, element[1]));
}

//! The element with the nearest box gives a bound that few others come below.
double unsigned_distance(const Prepared& surface, const Vec3& p)
{
    std::vector<double> to_box(surface.boxes.size());
    std::transform(surface.boxes.begin(), surface.boxes.end(), to_box.begin(),
                   [&](const Box& box) { return box.squaredExteriorDistance(p); });
    const auto first = std::min_element(to_box.begin(), to_box.end()) - to_box.begin();
    double nearest = distance(p, surface.elements[first]);
    for (std::size_t f = 0; f < to_box.size(); ++f) {
        if (to_box[f] < nearest * nearest) {
            nearest = std::min(nearest, distance(p, surface.elements[f]));
        }
    }
    return nearest;
}

int shared_corners(const Quad& a, const Quad& b)
{
    return static_cast<int>(
        std::count_if(a.begin(), a.end(), [&](int v) { return std::find(b.begin(), b.end(), v) != b.end(); }));
}

//! The triangle drawn in by a thousandth, so that what merely touches at a common corner does not count.
Triangle shrunk(const Triangle& t)
{
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
    Triangle result;
    std::transform(t.begin(), t.end(), result.begin(),
                   [&](const Vec3& p) { return Vec3(middle + 0.999 * (p - middle)); });
    return result;
}

bool elements_cross(const Surface& surface, Face f, Face g)
{
    for (const Triangle& s : triangles(surface, f)) {
        for (const Triangle& t : triangles(surface, g)) {
            if (cross(shrunk(s), shrunk(t))) {
                return true;
            }
        }
    }
    return false;
}

} // namespace

std::array<Triangle, 2> triangles(const Surface& surface, Face f)
{
    const Quad q = quad(surface, f);
    std::array<Vec3, 4> p;
    std::transform(q.begin(), q.end(), p.begin(), [&](int v) { return surface.point(Vertex(v)); });
    if ((p[0] - p[2]).squaredNorm() <= (p[1] - p[3]).squaredNorm()) {
        return {Triangle{p[0], p[1], p[2]}, Triangle{p[0], p[2], p[3]}};
    }
    return {Triangle{p[0], p[1], p[3]}, Triangle{p[1], p[2], p[3]}};
}

double distance(const Vec3& p, const Triangle& t)
{
    const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
    bool above = n.squaredNorm() > 0;
    double nearest = 1e300;
    for (int k = 0; k < 3; ++k) {
        above = above && n.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) >= 0;
        nearest = std::min(nearest, point_segment_distance(p, edge(t, k)));
    }
    return above ? std::abs(n.dot(p - t[0])) / n.norm() : nearest;
}

double distance(const Triangle& a, const Triangle& b)
{
    if (cross(a, b)) {
        return 0;
    }
    double nearest = 1e300;
    for (int i = 0; i < 3; ++i) {
        nearest = std::min({nearest, distance(a[i], b), distance(b[i], a)});
        for (int j = 0; j < 3; ++j) {
            nearest = std::min(nearest, segment_distance(edge(a, i), edge(b, j)));
        }
    }
    return nearest;
}

Overlap overlap(const Surface& a, const Surface& b, double touching)
{
    Overlap result{std::vector<char>(a.n_faces(), 0), std::vector<char>(b.n_faces(), 0)};
    const Prepared first(a);
    const Prepared second(b);
    Box whole;
    for (const Box& box : second.boxes) {
        whole.extend(box);
    }
    for (std::size_t f = 0; f < first.boxes.size(); ++f) {
        if (first.boxes[f].exteriorDistance(whole) > touching) {
            continue;
        }
        for (std::size_t g = 0; g < second.boxes.size(); ++g) {
            if (first.boxes[f].exteriorDistance(second.boxes[g]) <= touching &&
                close(first.elements[f], second.elements[g], touching)) {
                result.a[f] = 1;
                result.b[g] = 1;
                result.any = true;
            }
        }
    }
    return result;
}

double winding_number(const Surface& surface, const Vec3& p)
{
    return winding_number(Prepared(surface), p);
}

std::vector<double> signed_distances(const Surface& surface, const std::vector<Vec3>& points)
{
    const Prepared prepared(surface);
    std::vector<double> result;
    for (const Vec3& p : points) {
        const double nearest = unsigned_distance(prepared, p);
        result.push_back(winding_number(prepared, p) > 0.5 ? -nearest : nearest);
    }
    return result;
}

double signed_distance(const Surface& surface, const Vec3& p)
{
    return signed_distances(surface, {p}).front();
}

double rms_distance(const Surface& surface, const std::vector<Surface>& others)
{
    const std::vector<Prepared> prepared(others.begin(), others.end());
    double sum = 0;
    for (const Vertex v : surface.vertices()) {
        double nearest = 1e300;
        for (const Prepared& other : prepared) {
            nearest = std::min(nearest, unsigned_distance(other, surface.point(v)));
        }
        sum += nearest * nearest;
    }
    return std::sqrt(sum / static_cast<double>(surface.n_vertices()));
}

bool crosses_itself(const Surface& surface)
{
    const std::vector<Box> boxes = all_bounds(surface);
    std::vector<int> order(boxes.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int i, int j) { return boxes[i].min().x() < boxes[j].min().x(); });
    for (std::size_t i = 0; i < order.size(); ++i) { // the boxes are swept along x
        const Box& box = boxes[order[i]];
        for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].min().x() <= box.max().x(); ++j) {
            const Face f(order[i]);
            const Face g(order[j]);
            if (box.intersects(boxes[g.idx()]) && shared_corners(quad(surface, f), quad(surface, g)) < 2 &&
                elements_cross(surface, f, g)) {
                return true;
            }
        }
    }
    return false;
}

} // namespace rhombloom
