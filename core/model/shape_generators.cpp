#include "core/model/shape_generators.h"

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "core/model/tagging.h"

namespace rhombloom {

namespace {

void fill_tags(SurfaceLists& lists, Facing facing)
{
    lists.facing.resize(lists.quads.size(), facing);
    lists.component.assign(lists.quads.size(), 0);
    lists.serial.resize(lists.quads.size());
    std::iota(lists.serial.begin(), lists.serial.end(), 0);
}

//! \brief Rows of n elements between levels of vertices; level l is turned by l / 2 steps against level 0.
//! \details Row r (1-based) spans levels r-1, r and r+1. `vertex(level, index)` numbers the vertices.
std::vector<Quad> staggered_rows(int n, int rows, const std::function<int(int, int)>& vertex)
{
    std::vector<Quad> quads;
    for (int r = 1; r <= rows; ++r) {
        for (int j = 0; j < n; ++j) {
            const int left = (j + n - 1) % n;
            quads.push_back({vertex(r - 1, j), vertex(r, left), vertex(r + 1, left), vertex(r, j)});
        }
    }
    return quads;
}

using RowFacings = std::vector<Facing>;

std::vector<Facing> per_element(const RowFacings& rows, int n)
{
    std::vector<Facing> result;
    for (const Facing facing : rows) {
        result.insert(result.end(), n, facing);
    }
    return result;
}

//! Sum over interior vertices of the squared distance of the defect from its target; impermissible ones cost more.
double defect_cost(const SurfaceLists& lists, const Element& element, const std::vector<double>& target)
{
    std::vector<double> defect(lists.positions.size(), two_pi);
    for (std::size_t f = 0; f < lists.quads.size(); ++f) {
        for (const int v : lists.quads[f]) {
            defect[v] -= corner_angle(element, lists.sides[v], lists.facing[f]);
        }
    }
    const DefectRange range = permissible_defect(element);
    double cost = 0;
    for (std::size_t v = 0; v < defect.size(); ++v) {
        if (!std::isnan(target[v])) {
            cost += std::pow(defect[v] - target[v], 2);
            cost += defect[v] < range.min || defect[v] > range.max ? 1e6 : 0;
        }
    }
    return cost;
}

//! Turn the rows so that the defects come close to \p target (NaN: boundary). Few rows: all choices; many: descent.
void choose_row_facings(SurfaceLists& lists, int n, int rows, const Element& element, const std::vector<double>& target)
{
    RowFacings best(rows);
    for (int r = 0; r < rows; ++r) {
        best[r] = r % 2 == 0 ? Facing::Front : Facing::Back;
    }
    const auto cost = [&](const RowFacings& facings) {
        lists.facing = per_element(facings, n);
        return defect_cost(lists, element, target);
    };
    double best_cost = cost(best);
    const auto consider = [&](const RowFacings& facings) {
        const double c = cost(facings);
        const bool better = c < best_cost - 1e-9;
        if (better) {
            best = facings;
            best_cost = c;
        }
        return better;
    };
    constexpr int exhaustive_rows = 10;
    if (rows <= exhaustive_rows) {
        for (int choice = 0; choice < (1 << rows); ++choice) {
            RowFacings facings(rows);
            for (int r = 0; r < rows; ++r) {
                facings[r] = (choice >> r & 1) != 0 ? Facing::Back : Facing::Front;
            }
            consider(facings);
        }
    } else {
        for (bool improved = true; improved;) {
            improved = false;
            for (int r = 0; r < rows; ++r) {
                for (int s = r; s < std::min(rows, r + 3); ++s) { // turn rows r..s
                    RowFacings facings = best;
                    for (int t = r; t <= s; ++t) {
                        facings[t] = facings[t] == Facing::Front ? Facing::Back : Facing::Front;
                    }
                    improved = consider(facings) || improved;
                }
            }
        }
    }
    lists.facing = per_element(best, n);
}

Vec3 on_circle(double radius, double turns, double z)
{
    return {radius * std::cos(two_pi * turns), radius * std::sin(two_pi * turns), z};
}

constexpr double column_width = 1.05; // of a staggered row, per element, in units of la
constexpr double level_height = 0.85; // between levels

std::vector<Side> sides_by_level(const std::vector<int>& level)
{
    std::vector<Side> sides;
    for (const int l : level) {
        sides.push_back(l % 2 == 0 ? Side::Long : Side::Short);
    }
    return sides;
}

} // namespace

SurfaceLists join(const Triangulation& triangulation)
{
    SurfaceLists lists;
    lists.positions = triangulation.points;
    lists.sides.assign(triangulation.points.size(), Side::Long);
    std::map<std::pair<int, int>, int> centre_left; // of the directed edge
    for (const auto& t : triangulation.triangles) {
        const int centre = static_cast<int>(lists.positions.size());
        lists.positions.push_back(
            (triangulation.points[t[0]] + triangulation.points[t[1]] + triangulation.points[t[2]]) / 3);
        lists.sides.push_back(Side::Short);
        for (int k = 0; k < 3; ++k) {
            centre_left[{t[k], t[(k + 1) % 3]}] = centre;
        }
    }
    for (const auto& [edge, left] : centre_left) {
        const auto [p, q] = edge;
        if (p < q) {
            lists.quads.push_back({p, centre_left.at({q, p}), q, left});
        }
    }
    fill_tags(lists, Facing::Front);
    return lists;
}

SurfaceLists polar_stack(int n, int rows, const Element& element)
{
    expects(n >= 3 && rows >= 2, "polar_stack: n >= 3, rows >= 2");
    SurfaceLists lists;
    const int bottom = n * rows + 1;
    const auto vertex = [&](int level, int i) {
        return level == 0 ? 0 : level == rows + 1 ? bottom : 1 + (level - 1) * n + i;
    };
    const double radius = n * column_width / two_pi;
    const double half_height = (rows + 1) * level_height / 2;
    std::vector<int> level_of;
    for (int level = 0; level <= rows + 1; ++level) {
        const double angle = pi * level / (rows + 1);
        const bool pole = level == 0 || level == rows + 1;
        for (int i = 0; i < (pole ? 1 : n); ++i) {
            lists.positions.push_back(
                on_circle(radius * std::sin(angle), (i + 0.5 * level) / n, half_height * std::cos(angle)));
            level_of.push_back(level);
        }
    }
    lists.quads = staggered_rows(n, rows, vertex);
    lists.sides = sides_by_level(level_of);
    fill_tags(lists, Facing::Front);
    const double even = 4 * pi / static_cast<double>(lists.positions.size());
    choose_row_facings(lists, n, rows, element, std::vector<double>(lists.positions.size(), even));
    return lists;
}

SurfaceLists dome(int n, int rows, const Element& element)
{
    expects(n >= 3 && rows >= 1, "dome: n >= 3, rows >= 1");
    SurfaceLists lists;
    const auto vertex = [&](int level, int i) { return level == 0 ? 0 : 1 + (level - 1) * n + i; };
    const double radius = n * column_width / two_pi;
    std::vector<int> level_of;
    std::vector<double> target;
    for (int level = 0; level <= rows + 1; ++level) {
        const double angle = std::min(pi / 2, level * level_height / radius);
        const double below = std::max(0.0, level * level_height - radius * pi / 2);
        for (int i = 0; i < (level == 0 ? 1 : n); ++i) {
            lists.positions.push_back(
                on_circle(radius * std::sin(angle), (i + 0.5 * level) / n, radius * std::cos(angle) - below));
            level_of.push_back(level);
            const bool inner = level < rows; // levels rows and rows + 1 are the rim
            target.push_back(inner ? two_pi / (1 + n * (rows - 1)) : std::numeric_limits<double>::quiet_NaN());
        }
    }
    lists.quads = staggered_rows(n, rows, vertex);
    lists.sides = sides_by_level(level_of);
    fill_tags(lists, Facing::Front);
    choose_row_facings(lists, n, rows, element, target);
    return lists;
}

SurfaceLists tube(int n, int rows)
{
    expects(n >= 3 && rows >= 1, "tube: n >= 3, rows >= 1");
    SurfaceLists lists;
    const auto vertex = [&](int level, int i) { return level * n + i; };
    const double radius = n * column_width / two_pi;
    std::vector<int> level_of;
    for (int level = 0; level <= rows + 1; ++level) {
        for (int i = 0; i < n; ++i) {
            lists.positions.push_back(on_circle(radius, (i + 0.5 * level) / n, -level * level_height));
            level_of.push_back(level);
        }
    }
    lists.quads = staggered_rows(n, rows, vertex);
    lists.sides = sides_by_level(level_of);
    fill_tags(lists, Facing::Front);
    // Alternating rows: two acute and two obtuse corners at every inner vertex, the long diagonals along the tube.
    for (std::size_t f = 0; f < lists.quads.size(); ++f) {
        lists.facing[f] = (static_cast<int>(f) / n) % 2 == 0 ? Facing::Front : Facing::Back;
    }
    return lists;
}

SurfaceLists torus(int n, int rows)
{
    expects(n >= 3 && rows >= 6 && rows % 4 == 2, "torus: n >= 3, rows = 6, 10, 14, ...");
    SurfaceLists lists;
    // Once round the tube, the levels have turned by rows / 2 steps.
    const auto vertex = [&](int level, int i) {
        const int turned = level >= rows ? i + rows / 2 : i;
        return (level % rows) * n + turned % n;
    };
    const double ring = n * column_width / two_pi;
    const double tube_radius = rows * level_height / two_pi;
    std::vector<int> level_of;
    for (int level = 0; level < rows; ++level) {
        const double angle = two_pi * level / rows;
        for (int i = 0; i < n; ++i) {
            lists.positions.push_back(
                on_circle(ring + tube_radius * std::cos(angle), (i + 0.5 * level) / n, -tube_radius * std::sin(angle)));
            level_of.push_back(level);
        }
    }
    lists.quads = staggered_rows(n, rows, vertex);
    lists.sides = sides_by_level(level_of);
    fill_tags(lists, Facing::Front);
    // A row with its long diagonals round the ring is wider than one with them round the tube: outside the wide rows.
    for (std::size_t f = 0; f < lists.quads.size(); ++f) {
        const int row = static_cast<int>(f) / n + 1;
        const bool outside = std::cos(two_pi * row / rows) > 0;
        lists.facing[f] = outside == (row % 2 == 0) ? Facing::Front : Facing::Back;
    }
    return lists;
}

SurfaceLists sheet(int columns, int rows)
{
    expects(columns >= 1 && rows >= 1, "sheet: columns >= 1, rows >= 1");
    SurfaceLists lists;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            lists.positions.emplace_back(i - 0.5 * columns, j - 0.5 * rows, 0);
            lists.sides.push_back((i + j) % 2 == 0 ? Side::Long : Side::Short);
        }
    }
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const int corner = j * (columns + 1) + i;
            lists.quads.push_back({corner, corner + 1, corner + columns + 2, corner + columns + 1});
            lists.facing.push_back((i + j) % 2 == 0 ? Facing::Front : Facing::Back);
        }
    }
    fill_tags(lists, Facing::Front);
    return lists;
}

namespace {

//! Divides the quads of a surface, sharing the vertices on common edges.
class Subdivision
{
public:
    Subdivision(const SurfaceLists& coarse, int k) : coarse_(coarse), k_(k)
    {
        fine.components = coarse.components;
        fine.positions = coarse.positions;
        fine.sides = coarse.sides;
        if (k % 2 == 0) {
            fine.sides.assign(coarse.sides.size(), Side::Long); // an even number of steps apart: one colour
        }
    }

    void divide(int f)
    {
        Quad q = coarse_.quads[f];
        if (coarse_.sides[q[0]] == Side::Short) {
            q = {q[1], q[2], q[3], q[0]};
        }
        const std::vector<int> grid = vertices(q);
        const Facing facing = coarse_.facing[f];
        const Facing other = facing == Facing::Front ? Facing::Back : Facing::Front;
        for (int j = 0; j < k_; ++j) {
            for (int i = 0; i < k_; ++i) {
                const int c = j * (k_ + 1) + i;
                fine.quads.push_back({grid[c], grid[c + 1], grid[c + k_ + 2], grid[c + k_ + 1]});
                fine.facing.push_back((i + j) % 2 == 1 ? other : facing);
                fine.component.push_back(coarse_.component[f]);
                fine.serial.push_back(static_cast<int>(fine.serial.size()));
            }
        }
    }

    SurfaceLists fine;

private:
    std::vector<int> vertices(const Quad& q)
    {
        std::vector<int> grid;
        for (int j = 0; j <= k_; ++j) {
            for (int i = 0; i <= k_; ++i) {
                if (j == 0 || j == k_) {
                    grid.push_back(j == 0 ? edge_vertex(q[0], q[1], i) : edge_vertex(q[3], q[2], i));
                } else if (i == 0 || i == k_) {
                    grid.push_back(i == 0 ? edge_vertex(q[0], q[3], j) : edge_vertex(q[1], q[2], j));
                } else {
                    grid.push_back(inner_vertex(q, i, j));
                }
            }
        }
        return grid;
    }

    int edge_vertex(int a, int b, int step)
    {
        if (step == 0 || step == k_) {
            return step == 0 ? a : b;
        }
        const std::array<int, 3> key = a < b ? std::array{a, b, step} : std::array{b, a, k_ - step};
        const auto known = on_edge_.find(key);
        if (known != on_edge_.end()) {
            return known->second;
        }
        const double t = static_cast<double>(step) / k_;
        return on_edge_[key] = add((1 - t) * coarse_.positions[a] + t * coarse_.positions[b], a, step);
    }

    int inner_vertex(const Quad& q, int i, int j)
    {
        const double s = static_cast<double>(i) / k_;
        const double t = static_cast<double>(j) / k_;
        const auto& p = coarse_.positions;
        const Vec3 low = (1 - s) * p[q[0]] + s * p[q[1]];
        const Vec3 high = (1 - s) * p[q[3]] + s * p[q[2]];
        return add((1 - t) * low + t * high, q[0], i + j);
    }

    int add(const Vec3& position, int corner, int steps)
    {
        const bool same_side = (fine.sides[corner] == Side::Long) == (steps % 2 == 0);
        fine.positions.push_back(position);
        fine.sides.push_back(same_side ? Side::Long : Side::Short);
        return static_cast<int>(fine.positions.size()) - 1;
    }

    const SurfaceLists& coarse_;
    int k_;
    std::map<std::array<int, 3>, int> on_edge_; // lower end, upper end, step from the lower end
};

} // namespace

SurfaceLists subdivide(const SurfaceLists& lists, int k)
{
    expects(k >= 1, "subdivide: k >= 1");
    Subdivision subdivision(lists, k);
    for (int f = 0; f < static_cast<int>(lists.quads.size()); ++f) {
        subdivision.divide(f);
    }
    return std::move(subdivision.fine);
}

} // namespace rhombloom
