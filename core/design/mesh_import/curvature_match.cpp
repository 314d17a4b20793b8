#include "core/design/mesh_import/curvature_match.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/design/mesh_import/metric_misfit.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;
using VertexHandle = EditMesh::VertexHandle;
using EdgeHandle = EditMesh::EdgeHandle;

constexpr double quantum = pi / 3; // curvature of one triangle more or less

//! Curvature that is gathered at a point of the target.
struct Site
{
    Vec3 point = Vec3::Zero();
    double curvature = 0;
};

//! The target's curvature at points a fraction of an edge apart: the target itself is finer than need be.
std::vector<Site> curvature_sites(const TriangleMesh& target, double edge)
{
    constexpr double cells_per_edge = 3;
    const std::vector<double> curvature = point_curvature(target);
    struct Cell
    {
        Site sum;
        int count = 0;
    };
    std::map<std::array<long, 3>, Cell> cells;
    for (std::size_t i = 0; i < curvature.size(); ++i) {
        const Vec3 p = target.points[i] * (cells_per_edge / edge);
        Cell& cell = cells[{std::lround(p.x()), std::lround(p.y()), std::lround(p.z())}];
        cell.sum.point += target.points[i];
        cell.sum.curvature += curvature[i];
        ++cell.count;
    }
    std::vector<Site> result;
    for (const auto& [key, cell] : cells) {
        result.push_back({cell.sum.point / cell.count, cell.sum.curvature});
    }
    return result;
}

//! The target's curvature, gathered at the corners of the nearest triangles.
VectorXd gathered_curvature(EditMesh& mesh, const std::vector<Site>& sites)
{
    VectorXd result = VectorXd::Zero(static_cast<int>(mesh.n_vertices()));
    const MeshTree tree(triangle_mesh(mesh));
    for (const Site& site : sites) {
        const Triangle& t = tree.mesh().triangles[tree.nearest(site.point).triangle];
        const auto nearer = [&](int a, int b) {
            return (tree.mesh().points[a] - site.point).squaredNorm() <
                   (tree.mesh().points[b] - site.point).squaredNorm();
        };
        result[*std::min_element(t.begin(), t.end(), nearer)] += site.curvature;
    }
    return result;
}

//! What a flip of \p e does to the residual: its ends lose a triangle (curvature grows), the other two gain one.
CurvatureChange flip_change(const EditMesh& mesh, EdgeHandle e)
{
    const auto h = mesh.halfedge_handle(e, 0);
    const auto [c, d] = opposite_vertices(mesh, e);
    return {{mesh.from_vertex_handle(h).idx(), mesh.to_vertex_handle(h).idx(), c.idx(), d.idx()},
            {-quantum, -quantum, quantum, quantum}};
}

double price(int degree, int max_degree)
{
    if (degree < 4 || degree > max_degree) {
        return 1e6;
    }
    const double off = degree - 6;
    return off * off * (std::abs(off) > 1 ? 2 : 1);
}

double degree_price_change(const EditMesh& mesh, const CurvatureChange& change, int max_degree)
{
    double result = 0;
    for (int i = 0; i < 4; ++i) {
        const int degree = static_cast<int>(mesh.valence(VertexHandle(change.vertex[i])));
        const int step = change.amount[i] < 0 ? -1 : 1;
        result += price(degree + step, max_degree) - price(degree, max_degree);
    }
    return result;
}

//! How many pairs of vertices of degree 7 and more, one of the four at least among them, are neighbours (counted twice)
//! or face each other across an edge.
double crowd(const EditMesh& mesh, const std::array<int, 4>& four)
{
    const auto is_high = [&](VertexHandle v) { return mesh.valence(v) >= 7; };
    double result = 0;
    for (const int i : four) {
        const VertexHandle v(i);
        if (!is_high(v)) {
            continue;
        }
        const auto count = [&](VertexHandle w) {
            const bool twice = std::find(four.begin(), four.end(), w.idx()) != four.end();
            return is_high(w) ? (twice ? 0.5 : 1.0) : 0.0;
        };
        for (const auto h : mesh.voh_range(v)) {
            const auto across = mesh.opposite_halfedge_handle(mesh.next_halfedge_handle(h));
            result += 2 * count(mesh.to_vertex_handle(h));
            result += count(mesh.to_vertex_handle(mesh.next_halfedge_handle(across)));
        }
    }
    return result;
}

class Random
{
public:
    explicit Random(unsigned seed) : state_(seed) {}
    double next() // in [0, 1)
    {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11) / 9007199254740992.0;
    }

private:
    unsigned long long state_;
};

class Matching
{
public:
    Matching(EditMesh& mesh, const MeshTree& target, const MatchOptions& options)
        : mesh_(mesh), target_(target), options_(options), temperature_(options.temperature), random_(options.seed),
          sites_(curvature_sites(target.mesh(), options.edge))
    {
    }

    void run();

private:
    MetricMisfit misfit();
    void sweep(MetricMisfit& misfit);
    bool try_flip(EdgeHandle e, const CurvatureChange& change, MetricMisfit& misfit);

    EditMesh& mesh_;
    const MeshTree& target_;
    const MatchOptions& options_;
    double temperature_;
    Random random_;
    std::vector<Site> sites_;
    double least_own_ = 0; //!< own square of a change, the least so far
};

//! One sweep over all edges. A flip that has changed the mesh around a vertex keeps others away from it.
void Matching::sweep(MetricMisfit& misfit)
{
    std::vector<bool> changed(mesh_.n_vertices(), false);
    for (const auto e : mesh_.edges()) {
        if (!may_flip(mesh_, e)) {
            continue;
        }
        const CurvatureChange change = flip_change(mesh_, e);
        const auto is_changed = [&](int v) { return changed[v]; };
        if (std::none_of(change.vertex.begin(), change.vertex.end(), is_changed) && try_flip(e, change, misfit)) {
            for (const int v : change.vertex) {
                changed[v] = true;
            }
        }
    }
}

bool Matching::try_flip(EdgeHandle e, const CurvatureChange& change, MetricMisfit& misfit)
{
    const double allowed = -temperature_ * std::log(std::max(random_.next(), 1e-12));
    const double prices = options_.regularity * degree_price_change(mesh_, change, options_.max_degree);
    const double first = prices + misfit.first_order(change) - allowed;
    const double before = options_.crowding * crowd(mesh_, change.vertex);
    if (first + least_own_ - before >= 0) {
        return false;
    }
    mesh_.flip(e);
    const double crowding = options_.crowding * crowd(mesh_, change.vertex) - before;
    if (first + least_own_ + crowding < 0) {
        const VectorXd response = misfit.response(change);
        const double own = MetricMisfit::own_square(change, response);
        least_own_ = least_own_ == 0 ? 0.9 * own : std::min(least_own_, own);
        if (first + own + crowding < 0) {
            misfit.apply(change, response);
            return true;
        }
    }
    mesh_.flip(e);
    return false;
}

} // namespace

std::vector<double> point_curvature(const TriangleMesh& mesh)
{
    std::vector<double> result(mesh.points.size(), two_pi);
    for (const Triangle& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const Vec3 a = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]];
            const Vec3 b = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
            result[t[k]] -= std::atan2(a.cross(b).norm(), a.dot(b));
        }
    }
    return result;
}

namespace {

void relax(EditMesh& mesh, const MeshTree& target, double edge, int sweeps)
{
    constexpr double stiffness = 0.6; // of the steps: a little over the relaxation of one point alone
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (const auto v : mesh.vertices()) {
            if (is_tip(mesh, v)) {
                continue;
            }
            Vec3 step = Vec3::Zero();
            int count = 0;
            for (const auto w : mesh.vv_range(v)) {
                const Vec3 side = mesh.point(w) - mesh.point(v);
                const double length = side.norm();
                step += length > 0 ? Vec3(side * (1 - edge / length)) : Vec3(Vec3::Zero());
                ++count;
            }
            const Vec3 where = target.nearest(mesh.point(v) + step / (stiffness * count)).point;
            if (may_move(mesh, v, where, VertexHandle())) {
                mesh.set_point(v, where);
            }
        }
    }
}

MetricMisfit Matching::misfit()
{
    VectorXd residual = gathered_curvature(mesh_, sites_);
    for (const auto v : mesh_.vertices()) {
        residual[v.idx()] -= (6 - static_cast<int>(mesh_.valence(v))) * quantum;
    }
    return {mesh_, std::move(residual)};
}

void Matching::run()
{
    constexpr int flip_sweeps = 4;
    constexpr int relax_sweeps = 6;
    for (int round = 0; round < options_.rounds; ++round) {
        MetricMisfit misfit = this->misfit();
        for (int k = 0; k < flip_sweeps; ++k) {
            sweep(misfit);
        }
        temperature_ *= options_.cooling;
        relax(mesh_, target_, options_.edge, relax_sweeps);
    }
}

} // namespace

void relax_springs(TriangleMesh& triangles, const MeshTree& target, double edge, int sweeps)
{
    EditMesh mesh = edit_mesh(triangles);
    relax(mesh, target, edge, sweeps);
    triangles = triangle_mesh(mesh);
}

void match_curvature(TriangleMesh& triangles, const MeshTree& target, const MatchOptions& options)
{
    EditMesh mesh = edit_mesh(triangles);
    Matching(mesh, target, options).run();
    triangles = triangle_mesh(mesh);
}

} // namespace rhombloom
