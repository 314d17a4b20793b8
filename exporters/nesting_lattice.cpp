#include "exporters/nesting_lattice.h"

#include <algorithm>
#include <cmath>

namespace rhombloom::nesting {

namespace {

//! Points of one edge that corners and even steps miss: nearest to the origin, and where \p directions meet it.
void add_special_points(const Vec2& a, const Vec2& b, const Polygon& directions, Polygon& points)
{
    const Vec2 ab = b - a;
    const double foot = -a.dot(ab) / ab.squaredNorm();
    if (foot > 0 && foot < 1) {
        points.push_back(a + foot * ab);
    }
    for (const Vec2& d : directions) {
        const double t = cross_2d(d, a) / cross_2d(ab, d);
        const Vec2 p = a + t * ab;
        if (t > 0 && t < 1 && p.dot(d) > 0) {
            points.push_back(p);
        }
    }
}

//! Directions of the axes and of the longest edges, both ways: straight rows run along them.
Polygon row_directions(const NoFit& region)
{
    Polygon edges;
    for (const Polygon& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            edges.push_back(contour[(i + 1) % contour.size()] - contour[i]);
        }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const Vec2& a, const Vec2& b) { return a.squaredNorm() > b.squaredNorm(); });
    edges.resize(std::min<std::size_t>(edges.size(), 12));
    for (const Vec2& axis : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
        edges.push_back(axis);
    }
    return edges;
}

//! Points on the boundary of \p region with y > 0 (or y = 0, x > 0): corners and steps of at most \p step.
Polygon half_boundary(const NoFit& region, double step)
{
    Polygon points;
    const Polygon directions = row_directions(region);
    for (const Polygon& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const Vec2 &a = contour[i], &b = contour[(i + 1) % contour.size()];
            add_special_points(a, b, directions, points);
            const int parts = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step)));
            for (int k = 0; k < parts; ++k) {
                points.push_back(a + (b - a) * (static_cast<double>(k) / parts));
            }
        }
    }
    std::erase_if(points, [](const Vec2& p) { return p.y() < 0 || (p.y() == 0 && p.x() < 0); });
    return points;
}

double boundary_length(const NoFit& region)
{
    double sum = 0;
    for (const Polygon& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            sum += (contour[(i + 1) % contour.size()] - contour[i]).norm();
        }
    }
    return sum;
}

//! Where edge a-b crosses edge c-d, both ends included.
void add_crossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, Polygon& points)
{
    const double between = cross_2d(b - a, d - c);
    if (between == 0) {
        return;
    }
    const double t = cross_2d(c - a, d - c) / between;
    const double u = cross_2d(c - a, b - a) / between;
    if (t >= 0 && t <= 1 && u >= 0 && u <= 1) {
        points.push_back(a + t * (b - a));
    }
}

struct Edge
{
    Vec2 a, b;
};

std::vector<Edge> edges_by_x(const NoFit& region)
{
    std::vector<Edge> edges;
    for (const Polygon& contour : region.contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            edges.push_back({contour[i], contour[(i + 1) % contour.size()]});
        }
    }
    std::stable_sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) {
        return std::min(e.a.x(), e.b.x()) < std::min(f.a.x(), f.b.x());
    });
    return edges;
}

//! Where the boundary crosses itself moved by \p shift.
void add_crossings(const std::vector<Edge>& edges, const Vec2& shift, Polygon& points)
{
    std::size_t begin = 0;
    double widest = 0;
    for (const Edge& e : edges) {
        widest = std::max(widest, std::abs(e.a.x() - e.b.x()));
    }
    for (const Edge& e : edges) {
        const double low = std::min(e.a.x(), e.b.x()), high = std::max(e.a.x(), e.b.x());
        const double bottom = std::min(e.a.y(), e.b.y()), top = std::max(e.a.y(), e.b.y());
        while (begin < edges.size() && std::min(edges[begin].a.x(), edges[begin].b.x()) + shift.x() < low - widest) {
            ++begin;
        }
        for (std::size_t k = begin; k < edges.size(); ++k) {
            const Vec2 c = edges[k].a + shift, d = edges[k].b + shift;
            if (std::min(c.x(), d.x()) > high) {
                break;
            }
            if (std::max(c.x(), d.x()) >= low && std::max(c.y(), d.y()) >= bottom && std::min(c.y(), d.y()) <= top) {
                add_crossing(e.a, e.b, c, d, points);
            }
        }
    }
}

bool multiples_clear(const NoFit& self, const Vec2& v)
{
    for (Vec2 p = v; p.norm() < self.reach; p += v) {
        if (overlaps(self, p)) {
            return false;
        }
    }
    return true;
}

void add_lattice(const NoFit& self, const Vec2& v1, const Vec2& v2, double worst, std::vector<Lattice>& found)
{
    const Lattice lattice = reduced({v1, v2});
    const double best = found.empty() ? 1e300 : found.front().cell();
    if (lattice.cell() > worst * best || lattice.v1.norm() < 1e-6 || !admissible(lattice, self)) {
        return;
    }
    found.push_back(lattice);
    if (lattice.cell() < best) {
        std::swap(found.front(), found.back());
    }
}

bool alike(const Lattice& a, const Lattice& b)
{
    const auto same = [](const Vec2& p, const Vec2& q) { return (p - q).norm() < 1e-4 || (p + q).norm() < 1e-4; };
    return same(a.v1, b.v1) && same(a.v2, b.v2);
}

void sort_and_trim(std::vector<Lattice>& found, const LatticeSearch& search)
{
    std::stable_sort(found.begin(), found.end(),
                     [](const Lattice& a, const Lattice& b) { return a.cell() < b.cell(); });
    std::vector<Lattice> kept;
    for (const Lattice& lattice : found) {
        if (lattice.cell() > search.worst * found.front().cell() || kept.size() >= std::size_t(search.keep)) {
            break;
        }
        const bool known = std::any_of(kept.rbegin(), kept.rend(), [&](const Lattice& k) { return alike(k, lattice); });
        if (!known) {
            kept.push_back(lattice);
        }
    }
    found = std::move(kept);
}

} // namespace

Lattice reduced(Lattice l)
{
    for (int i = 0; i < 100; ++i) {
        if (l.v1.squaredNorm() > l.v2.squaredNorm()) {
            std::swap(l.v1, l.v2);
        }
        if (l.v1.squaredNorm() < 1e-12) {
            break;
        }
        const double k = std::round(l.v1.dot(l.v2) / l.v1.squaredNorm());
        if (k == 0) {
            break;
        }
        l.v2 -= k * l.v1;
    }
    return l;
}

bool admissible(const Lattice& lattice, const NoFit& self)
{
    // In a reduced basis a point i v1 + j v2 is at least |j| |v2| sqrt(3)/2 and |i| |v1| sqrt(3)/2 long.
    const int rows = static_cast<int>(self.reach / (0.866 * lattice.v2.norm()));
    const int columns = static_cast<int>(self.reach / (0.866 * lattice.v1.norm()));
    for (int j = 0; j <= rows; ++j) {
        for (int i = j == 0 ? 1 : -columns; i <= columns; ++i) {
            if (overlaps(self, i * lattice.v1 + j * lattice.v2)) {
                return false;
            }
        }
    }
    return true;
}

std::vector<Lattice> lattices(const NoFit& self, const LatticeSearch& search)
{
    const double step = boundary_length(self) / 2 / search.samples;
    const Polygon points = half_boundary(self, step);
    const std::vector<Edge> edges = edges_by_x(self);
    std::vector<Lattice> found;
    for (const Vec2& v1 : points) {
        if (!multiples_clear(self, v1)) {
            continue;
        }
        Polygon seconds;
        add_crossings(edges, v1, seconds);
        add_crossings(edges, 2 * v1, seconds);
        for (const Vec2& v2 : seconds) {
            add_lattice(self, v1, v2, search.worst, found);
        }
    }
    if (search.between) {
        for (const Vec2& v1 : points) {
            for (const Vec2& v2 : points) {
                add_lattice(self, v1, v2, search.worst, found);
            }
        }
    }
    sort_and_trim(found, search);
    return found;
}

} // namespace rhombloom::nesting
