#pragma once

#include <cmath>
#include <map>
#include <random>

#include "core/model/surface.h"

//! Closed surfaces of any size for tests and benchmarks: joins of triangulations (one element per edge).
namespace rhombloom::shapes {

struct Triangulation
{
    std::vector<Vec3> positions;
    std::vector<std::array<int, 3>> triangles; //!< counter-clockwise seen from outside
};

inline Triangulation icosahedron()
{
    const double g = (1 + std::sqrt(5.0)) / 2;
    return {{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

//! Every triangle into four, the new vertices pushed out to the unit sphere.
inline Triangulation subdivided(const Triangulation& coarse)
{
    Triangulation fine;
    for (const Vec3& p : coarse.positions) {
        fine.positions.push_back(p.normalized());
    }
    std::map<std::pair<int, int>, int> middle;
    const auto middle_of = [&](int a, int b) {
        const auto [entry, fresh] = middle.emplace(std::minmax(a, b), static_cast<int>(fine.positions.size()));
        if (fresh) {
            fine.positions.push_back((fine.positions[a] + fine.positions[b]).normalized());
        }
        return entry->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        const int ab = middle_of(a, b);
        const int bc = middle_of(b, c);
        const int ca = middle_of(c, a);
        fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    return fine;
}

//! Two icosahedral caps of \p frequency with \p rows extra rows of triangles between them: 30 f^2 + 15 f rows edges.
//! Rings of vertices from north to south: ring k of a cap has 5 k vertices, those between 5 f, each turned by half a
//! step.
inline Triangulation capsule(int frequency, int rows)
{
    Triangulation mesh;
    const int f = frequency;
    const int total = 3 * f + rows;
    const double radius = 5.0 * f / two_pi;
    std::vector<int> first;
    const auto size = [&](int k) { return 5 * std::min({k, f, total - k}); };
    for (int k = 0; k <= total; ++k) {
        first.push_back(static_cast<int>(mesh.positions.size()));
        const int row = std::clamp(k - f, 0, f + rows);
        const double straight = rows / double(f + rows) * row; // of the rows so far, those that bend nothing
        const double polar = pi * (k - straight) / (3 * f);
        const double z = radius * std::cos(polar) + 0.87 * (0.5 * rows - straight);
        for (int i = 0; i < std::max(1, size(k)); ++i) {
            const double phi = two_pi * (double(i) / std::max(1, size(k)) + 0.5 * row / (5 * f));
            mesh.positions.emplace_back(radius * std::sin(polar) * std::cos(phi),
                                        radius * std::sin(polar) * std::sin(phi), z);
        }
    }
    const auto at = [&](int k, int sector, int i) {
        return size(k) == 0 ? first[k] : first[k] + (sector * size(k) / 5 + i) % size(k);
    };
    for (int k = 0; k < total; ++k) {
        const int upper = size(k) / 5;
        const int lower = size(k + 1) / 5;
        for (int s = 0; s < 5; ++s) {
            for (int i = 0; i < lower; ++i) {
                mesh.triangles.push_back({at(k, s, i + (upper >= lower)), at(k + 1, s, i), at(k + 1, s, i + 1)});
            }
            for (int i = 0; i < upper; ++i) {
                mesh.triangles.push_back({at(k, s, i), at(k + 1, s, i + (upper < lower)), at(k, s, i + 1)});
            }
        }
    }
    return mesh;
}

//! 3 * around * across edges; \p around must be even for a round row of triangles to close.
inline Triangulation torus(int around, int across)
{
    Triangulation mesh;
    const double big = around / two_pi;
    const double small = 0.87 * across / two_pi;
    for (int j = 0; j < across; ++j) {
        for (int i = 0; i < around; ++i) {
            const double u = two_pi * (i + 0.5 * (j % 2)) / around;
            const double v = two_pi * j / across;
            const double r = big + small * std::cos(v);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), small * std::sin(v));
        }
    }
    const auto at = [&](int i, int j) { return (j % across) * around + i % around; };
    for (int j = 0; j < across; ++j) {
        for (int i = 0; i < around; ++i) {
            const int shift = j % 2; // rows are shifted by half a step
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + shift, j + 1)});
            mesh.triangles.push_back({at(i + 1, j), at(i + 1 + shift, j + 1), at(i + shift, j + 1)});
        }
    }
    return mesh;
}

//! One element per edge: edge p-q becomes the quad p, right triangle's centre, q, left triangle's centre. The vertices
//! of the triangulation are Long, all elements face Front. Scaled so that the mean edge is la.
inline SurfaceLists join(const Triangulation& mesh, const Element& element)
{
    SurfaceLists out;
    out.positions = mesh.positions;
    out.sides.assign(mesh.positions.size(), Side::Long);
    std::map<std::pair<int, int>, int> left;
    for (const auto& t : mesh.triangles) {
        const int centre = static_cast<int>(out.positions.size());
        out.positions.push_back((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3);
        out.sides.push_back(Side::Short);
        for (int k = 0; k < 3; ++k) {
            left[{t[k], t[(k + 1) % 3]}] = centre;
        }
    }
    double length = 0;
    for (const auto& [edge, centre] : left) {
        const auto [p, q] = edge;
        length += (out.positions[p] - out.positions[centre]).norm() + (out.positions[q] - out.positions[centre]).norm();
        if (p < q) {
            out.quads.push_back({p, left.at({q, p}), q, centre});
        }
    }
    for (Vec3& p : out.positions) {
        p *= element.la * 2.0 * static_cast<double>(left.size()) / length;
    }
    out.facing.assign(out.quads.size(), Facing::Front);
    out.component.assign(out.quads.size(), 0);
    out.serial.assign(out.quads.size(), -1);
    return out;
}

//! The join of the icosahedron subdivided \p level times: 30 * 4^level elements.
inline SurfaceLists ball(int level, const Element& element)
{
    Triangulation mesh = icosahedron();
    for (int k = 0; k < level; ++k) {
        mesh = subdivided(mesh);
    }
    return join(mesh, element);
}

inline Surface ball_surface(int level, const Element& element = {})
{
    return make_surface(ball(level, element)).value();
}

//! Normally distributed noise of \p sigma mm per coordinate.
inline void add_noise(Surface& surface, double sigma, unsigned seed)
{
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, sigma);
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, surface.point(v) + Vec3(normal(random), normal(random), normal(random)));
    }
}

} // namespace rhombloom::shapes
