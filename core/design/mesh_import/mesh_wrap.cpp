#include "core/design/mesh_import/mesh_wrap.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace rhombloom {

namespace {

using Index3 = Eigen::Vector3i;

//! Samples at the corners of cubic cells around a mesh.
struct Grid
{
    Vec3 origin = Vec3::Zero();
    double cell = 1;
    Index3 counts = Index3::Zero();
    std::vector<signed char> inside; //!< of each corner: 1 inside, 0 outside, -1 not known yet

    int number(const Index3& i) const { return (i.z() * counts.y() + i.y()) * counts.x() + i.x(); }
    Index3 index(int n) const { return {n % counts.x(), n / counts.x() % counts.y(), n / counts.x() / counts.y()}; }
    // A little off the corners themselves, in no special direction: flat faces of a mesh often lie on round numbers.
    Vec3 point(const Index3& i) const { return origin + cell * (i.cast<double>() + Vec3(0.0137, 0.0071, 0.0113)); }
};

Grid make_grid(const TriangleMesh& mesh, double cell, double margin)
{
    const Eigen::AlignedBox3d box = bounds(mesh);
    Grid grid;
    grid.cell = cell;
    const int around = 2 + static_cast<int>(std::ceil(margin / cell));
    grid.origin = box.min() - Vec3::Constant(around * cell);
    grid.counts = ((box.sizes() / cell).array().ceil().cast<int>() + 2 * around + 1).matrix();
    grid.inside.assign(static_cast<std::size_t>(grid.counts.prod()), -1);
    return grid;
}

//! Evaluate the corners next to the mesh; only there can the sign change.
void sample_near(const MeshTree& tree, Grid& grid)
{
    std::vector<bool> near(grid.inside.size(), false);
    for (const Triangle& t : tree.mesh().triangles) {
        Eigen::AlignedBox3d box;
        for (const int v : t) {
            box.extend(tree.mesh().points[v]);
        }
        const Index3 low = ((box.min() - grid.origin) / grid.cell).array().floor().cast<int>() - 0;
        const Index3 high = ((box.max() - grid.origin) / grid.cell).array().floor().cast<int>() + 1;
        const Vec3 normal = area_normal(tree.mesh(), t).normalized();
        const Vec3& corner = tree.mesh().points[t[0]];
        for (int z = std::max(low.z(), 0); z <= std::min(high.z(), grid.counts.z() - 1); ++z) {
            for (int y = std::max(low.y(), 0); y <= std::min(high.y(), grid.counts.y() - 1); ++y) {
                for (int x = std::max(low.x(), 0); x <= std::min(high.x(), grid.counts.x() - 1); ++x) {
                    const double height = normal.dot(grid.point({x, y, z}) - corner);
                    near[grid.number({x, y, z})] =
                        near[grid.number({x, y, z})] || !(std::abs(height) > 1.8 * grid.cell);
                }
            }
        }
    }
    for (int n = 0; n < static_cast<int>(near.size()); ++n) {
        if (near[n]) {
            grid.inside[n] = tree.winding_number(grid.point(grid.index(n))) > 0.5 ? 1 : 0;
        }
    }
}

template <class Visit>
void for_neighbours(const Grid& grid, int n, const Visit& visit)
{
    const Index3 i = grid.index(n);
    for (int axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
            Index3 j = i;
            j[axis] += step;
            if (j[axis] >= 0 && j[axis] < grid.counts[axis]) {
                visit(grid.number(j));
            }
        }
    }
}

//! Every region of unknown corners is inside or outside as a whole.
void fill_regions(const MeshTree& tree, Grid& grid)
{
    for (int seed = 0; seed < static_cast<int>(grid.inside.size()); ++seed) {
        if (grid.inside[seed] >= 0) {
            continue;
        }
        const signed char value = tree.winding_number(grid.point(grid.index(seed))) > 0.5 ? 1 : 0;
        std::vector<int> stack = {seed};
        grid.inside[seed] = value;
        while (!stack.empty()) {
            const int n = stack.back();
            stack.pop_back();
            for_neighbours(grid, n, [&](int m) {
                if (grid.inside[m] < 0) {
                    grid.inside[m] = value;
                    stack.push_back(m);
                }
            });
        }
    }
}

//! Squared distances along one line, from squared distances across it (Felzenszwalb and Huttenlocher 2012): the lower
//! envelope of one parabola per corner.
void spread(std::vector<double>& line)
{
    const int n = static_cast<int>(line.size());
    std::vector<int> lowest;   // corners whose parabolas are on the envelope
    std::vector<double> begin; // where each takes over
    const auto crossing = [&](int a, int b) {
        return ((line[b] + 1.0 * b * b) - (line[a] + 1.0 * a * a)) / (2.0 * (b - a));
    };
    for (int k = 0; k < n; ++k) {
        while (!lowest.empty() && crossing(lowest.back(), k) <= begin.back()) {
            lowest.pop_back();
            begin.pop_back();
        }
        begin.push_back(lowest.empty() ? -1e30 : crossing(lowest.back(), k));
        lowest.push_back(k);
    }
    std::vector<double> result(line.size());
    std::size_t at = 0;
    for (int k = 0; k < n; ++k) {
        while (at + 1 < begin.size() && begin[at + 1] < k) {
            ++at;
        }
        const double off = k - lowest[at];
        result[k] = off * off + line[lowest[at]];
    }
    line = std::move(result);
}

//! Squared distance in cells of every corner from the nearest one that is \p wanted.
std::vector<double> squared_distances(const Grid& grid, signed char wanted)
{
    constexpr double far = 1e12;
    std::vector<double> result;
    for (const signed char inside : grid.inside) {
        result.push_back(inside == wanted ? 0 : far);
    }
    for (int axis = 0; axis < 3; ++axis) {
        Index3 step = Index3::Zero();
        step[axis] = 1;
        const int stride = grid.number(step);
        std::vector<double> line(grid.counts[axis]);
        for (int n = 0; n < static_cast<int>(result.size()); ++n) {
            if (grid.index(n)[axis] != 0) {
                continue;
            }
            for (std::size_t k = 0; k < line.size(); ++k) {
                line[k] = result[n + stride * static_cast<int>(k)];
            }
            spread(line);
            for (std::size_t k = 0; k < line.size(); ++k) {
                result[n + stride * static_cast<int>(k)] = line[k];
            }
        }
    }
    return result;
}

//! Fill what a ball of that radius does not reach from outside.
void close(Grid& grid, double radius)
{
    const double reach = std::pow(radius / grid.cell + 0.5, 2); // surfaces are half a cell from corners
    Grid wider = grid;
    const std::vector<double> to_solid = squared_distances(grid, 1);
    std::vector<int> stack = {0}; // the first corner is outside
    std::fill(wider.inside.begin(), wider.inside.end(), 1);
    wider.inside[0] = 0;
    while (!stack.empty()) {
        const int n = stack.back();
        stack.pop_back();
        for_neighbours(grid, n, [&](int m) {
            if (wider.inside[m] == 1 && to_solid[m] > reach) {
                wider.inside[m] = 0;
                stack.push_back(m);
            }
        });
    }
    const std::vector<double> to_free = squared_distances(wider, 0);
    for (std::size_t n = 0; n < to_free.size(); ++n) {
        grid.inside[n] = grid.inside[n] == 1 || to_free[n] > reach ? 1 : 0;
    }
}

//! The cut of a grid edge, halfway; each edge has one point.
class Cuts
{
public:
    Cuts(const Grid& grid, TriangleMesh& mesh) : grid_(grid), mesh_(mesh) {}

    int point(int a, int b)
    {
        const auto [found, fresh] = number_.emplace(std::minmax(a, b), static_cast<int>(mesh_.points.size()));
        if (fresh) {
            mesh_.points.emplace_back((grid_.point(grid_.index(a)) + grid_.point(grid_.index(b))) / 2);
        }
        return found->second;
    }

private:
    const Grid& grid_;
    TriangleMesh& mesh_;
    std::map<std::pair<int, int>, int> number_;
};

void add_facing(const Grid& grid, int inner, Triangle t, TriangleMesh& mesh)
{
    const Vec3 away = mesh.points[t[0]] - grid.point(grid.index(inner));
    if (area_normal(mesh, t).dot(away) < 0) {
        std::swap(t[1], t[2]);
    }
    mesh.triangles.push_back(t);
}

void cut_tetrahedron(const Grid& grid, const std::array<int, 4>& corners, Cuts& cuts, TriangleMesh& mesh)
{
    std::array<int, 4> in{};
    std::array<int, 4> out{};
    int ins = 0;
    int outs = 0;
    for (const int c : corners) {
        (grid.inside[c] == 1 ? in[ins++] : out[outs++]) = c;
    }
    if (ins == 1 || outs == 1) {
        const int lone = ins == 1 ? in[0] : out[0];
        const std::array<int, 4>& others = ins == 1 ? out : in;
        add_facing(grid, in[0], {cuts.point(lone, others[0]), cuts.point(lone, others[1]), cuts.point(lone, others[2])},
                   mesh);
    } else if (ins == 2) {
        const int a = cuts.point(in[0], out[0]);
        const int b = cuts.point(in[0], out[1]);
        const int c = cuts.point(in[1], out[1]);
        const int d = cuts.point(in[1], out[0]);
        add_facing(grid, in[0], {a, b, c}, mesh);
        add_facing(grid, in[0], {a, c, d}, mesh);
    }
}

TriangleMesh march(const Grid& grid)
{
    // Six tetrahedra about the diagonal of each cell; corners are numbered by the bits x, y, z.
    constexpr int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                      {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    TriangleMesh mesh;
    Cuts cuts(grid, mesh);
    for (int n = 0; n < static_cast<int>(grid.inside.size()); ++n) {
        const Index3 i = grid.index(n);
        if ((i.array() + 1 >= grid.counts.array()).any()) {
            continue;
        }
        std::array<int, 8> corner{};
        int ins = 0;
        for (int b = 0; b < 8; ++b) {
            corner[b] = grid.number(i + Index3(b & 1, b >> 1 & 1, b >> 2 & 1));
            ins += grid.inside[corner[b]];
        }
        if (ins == 0 || ins == 8) {
            continue;
        }
        for (const auto& t : tetrahedra) {
            cut_tetrahedron(grid, {corner[t[0]], corner[t[1]], corner[t[2]], corner[t[3]]}, cuts, mesh);
        }
    }
    return mesh;
}

//! Move every point to the mean of its neighbours, then onto the mesh where that is near.
void draw_near(const MeshTree& tree, double cell, TriangleMesh& mesh)
{
    constexpr int passes = 6;
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<Vec3> sum(mesh.points.size(), Vec3::Zero());
        std::vector<int> count(mesh.points.size(), 0);
        for (const Triangle& t : mesh.triangles) {
            for (int k = 0; k < 3; ++k) {
                sum[t[k]] += mesh.points[t[(k + 1) % 3]];
                ++count[t[k]];
            }
        }
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            const Vec3 mean = count[v] > 0 ? Vec3(sum[v] / count[v]) : mesh.points[v];
            const NearestPoint near = tree.nearest(mean);
            mesh.points[v] = near.distance < cell ? near.point : mean;
        }
    }
}

} // namespace

TriangleMesh wrap(const MeshTree& tree, const WrapOptions& options)
{
    Grid grid = make_grid(tree.mesh(), options.cell, options.closing);
    sample_near(tree, grid);
    fill_regions(tree, grid);
    if (options.closing > 0) {
        close(grid, options.closing);
    }
    TriangleMesh mesh = march(grid);
    draw_near(tree, options.cell, mesh);
    return mesh;
}

} // namespace rhombloom
