#include "core/model/triangulation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace rhombloom {

namespace {

using Triangle = std::array<int, 3>;

std::vector<Vec3> corners(Deltahedron base)
{
    if (base == Deltahedron::Tetrahedron) {
        return {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    }
    if (base == Deltahedron::Octahedron) {
        return {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    }
    // Two poles and two rings of five at latitude +-atan(1/2), so that a five-fold axis is vertical.
    std::vector<Vec3> points = {{0, 0, 1}};
    for (int ring = 0; ring < 2; ++ring) {
        for (int i = 0; i < 5; ++i) {
            const double angle = two_pi * (i + 0.5 * ring) / 5;
            points.emplace_back(2 * std::cos(angle) / std::sqrt(5.0), 2 * std::sin(angle) / std::sqrt(5.0),
                                (ring == 0 ? 1 : -1) / std::sqrt(5.0));
        }
    }
    points.emplace_back(0, 0, -1);
    return points;
}

//! Symmetric point sets have many points in one plane; a tiny fixed disturbance decides those cases one way.
std::vector<Vec3> disturbed(std::vector<Vec3> points)
{
    unsigned state = 1;
    for (Vec3& p : points) {
        for (double& x : p) {
            state = state * 1664525U + 1013904223U; // linear congruential generator, the same everywhere
            x += 1e-7 * (state / 4294967296.0 - 0.5);
        }
        p.normalize();
    }
    return points;
}

bool sees(const std::vector<Vec3>& p, const Triangle& t, int i)
{
    const Vec3 normal = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
    return normal.dot(p[i] - p[t[0]]) > 0;
}

//! Add one point: the faces it sees give way to a cone over their rim.
void add_to_hull(const std::vector<Vec3>& p, std::vector<Triangle>& hull, int i)
{
    std::vector<Triangle> kept;
    std::set<std::pair<int, int>> seen_edges;
    for (const Triangle& t : hull) {
        if (!sees(p, t, i)) {
            kept.push_back(t);
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            seen_edges.emplace(t[k], t[(k + 1) % 3]);
        }
    }
    for (const auto& [a, b] : seen_edges) {
        if (!seen_edges.contains({b, a})) {
            kept.push_back({a, b, i});
        }
    }
    hull = std::move(kept);
}

//! Points of the triangular lattice inside the face (0,0), (a,b), (-b,a+b), as barycentric weights.
std::vector<Vec3> lattice_weights(int a, int b)
{
    const int T = a * a + a * b + b * b;
    std::vector<Vec3> weights;
    for (int i = -b; i <= a; ++i) {
        for (int j = 0; j <= a + b; ++j) {
            // (i, j) = s (a, b) + t (-b, a + b), all scaled by T to stay in integers
            const int s = i * (a + b) + j * b;
            const int t = j * a - i * b;
            if (s >= 0 && t >= 0 && s + t <= T) {
                weights.emplace_back(double(T - s - t) / T, double(s) / T, double(t) / T);
            }
        }
    }
    return weights;
}

void add_if_new(std::vector<Vec3>& points, const Vec3& p)
{
    const auto same = [&](const Vec3& q) { return (p - q).norm() < 1e-6; };
    if (std::none_of(points.begin(), points.end(), same)) {
        points.push_back(p);
    }
}

} // namespace

Triangulation sphere_hull(std::vector<Vec3> points)
{
    expects(points.size() >= 4, "sphere_hull: at least four points");
    const std::vector<Vec3> p = disturbed(points);
    const int n = static_cast<int>(points.size());
    const auto volume = [&](int d) { return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[d] - p[0]); };
    int fourth = 3; // with points 0, 1 and 2 the largest tetrahedron
    for (int d = 4; d < n; ++d) {
        if (std::abs(volume(d)) > std::abs(volume(fourth))) {
            fourth = d;
        }
    }
    const Triangle base = volume(fourth) > 0 ? Triangle{0, 2, 1} : Triangle{0, 1, 2};
    std::vector<Triangle> hull = {
        base, {base[1], base[0], fourth}, {base[2], base[1], fourth}, {base[0], base[2], fourth}};
    for (int i = 3; i < n; ++i) {
        if (i != fourth) {
            add_to_hull(p, hull, i);
        }
    }
    return {std::move(points), std::move(hull)};
}

Triangulation geodesic(Deltahedron base, int a, int b)
{
    expects(a >= 1 && b >= 0, "geodesic: a >= 1 and b >= 0");
    std::vector<Vec3> points = corners(base);
    for (Vec3& p : points) {
        p.normalize();
    }
    const Triangulation polyhedron = sphere_hull(points);
    const std::vector<Vec3> weights = lattice_weights(a, b);
    for (const Triangle& t : polyhedron.triangles) {
        for (const Vec3& w : weights) {
            const Vec3 p = w[0] * points[t[0]] + w[1] * points[t[1]] + w[2] * points[t[2]];
            add_if_new(points, p.normalized());
        }
    }
    return sphere_hull(std::move(points));
}

} // namespace rhombloom
