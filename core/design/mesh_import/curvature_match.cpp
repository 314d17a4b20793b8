#include "core/design/mesh_import/curvature_match.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/design/mesh_import/remesh_mesh.h"

namespace rhombloom {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using VertexHandle = EditMesh::VertexHandle;
using EdgeHandle = EditMesh::EdgeHandle;

constexpr double quantum = pi / 3; // curvature of one triangle more or less

//! The target's curvature, gathered at the corners of the nearest triangles.
VectorXd target_curvature(EditMesh& mesh, const MeshTree& target, const std::vector<double>& curvature)
{
    VectorXd result = VectorXd::Zero(static_cast<int>(mesh.n_vertices()));
    const MeshTree tree(triangle_mesh(mesh));
    for (std::size_t i = 0; i < curvature.size(); ++i) {
        const Vec3& p = target.mesh().points[i];
        const Triangle& t = tree.mesh().triangles[tree.nearest(p).triangle];
        const auto nearer = [&](int a, int b) {
            return (tree.mesh().points[a] - p).squaredNorm() < (tree.mesh().points[b] - p).squaredNorm();
        };
        result[*std::min_element(t.begin(), t.end(), nearer)] += curvature[i];
    }
    return result;
}

//! The square of: inverse Laplacian for equilateral triangles, then smoothing over the length of an edge. Shorter waves
//! of the metric's misfit buckle away and cost hardly any distance.
MatrixXd squared_inverse(const EditMesh& mesh)
{
    const int n = static_cast<int>(mesh.n_vertices());
    const double weight = 1 / std::sqrt(3.0);
    MatrixXd laplacian = MatrixXd::Constant(n, n, 1.0 / n);
    for (const auto e : mesh.edges()) {
        const int a = mesh.to_vertex_handle(mesh.halfedge_handle(e, 0)).idx();
        const int b = mesh.to_vertex_handle(mesh.halfedge_handle(e, 1)).idx();
        laplacian(a, a) += weight;
        laplacian(b, b) += weight;
        laplacian(a, b) -= weight;
        laplacian(b, a) -= weight;
    }
    const MatrixXd identity = MatrixXd::Identity(n, n);
    MatrixXd inverse = laplacian.llt().solve(identity);
    inverse.array() -= 1.0 / n;
    const MatrixXd smoothed = (identity + laplacian).llt().solve(inverse);
    return smoothed.transpose() * smoothed;
}

struct Misfit
{
    MatrixXd square;   //!< squared inverse Laplacian
    VectorXd residual; //!< target's curvature minus ours
    VectorXd pull;     //!< square * residual
};

struct Change
{
    std::array<int, 4> vertex{};
    std::array<double, 4> amount{}; //!< added to the residual
};

double misfit_change(const Misfit& misfit, const Change& change)
{
    double result = 0;
    for (int i = 0; i < 4; ++i) {
        result += 2 * change.amount[i] * misfit.pull[change.vertex[i]];
        for (int j = 0; j < 4; ++j) {
            result += change.amount[i] * change.amount[j] * misfit.square(change.vertex[i], change.vertex[j]);
        }
    }
    return result;
}

void apply(const Change& change, Misfit& misfit)
{
    for (int i = 0; i < 4; ++i) {
        misfit.residual[change.vertex[i]] += change.amount[i];
        misfit.pull += change.amount[i] * misfit.square.col(change.vertex[i]);
    }
}

//! What a flip of \p e does to the residual: its ends lose a triangle (curvature grows), the other two gain one.
Change flip_change(const EditMesh& mesh, EdgeHandle e)
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

double price_change(const EditMesh& mesh, const Change& change, int max_degree)
{
    double result = 0;
    for (int i = 0; i < 4; ++i) {
        const int degree = static_cast<int>(mesh.valence(VertexHandle(change.vertex[i])));
        const int step = change.amount[i] < 0 ? -1 : 1;
        result += price(degree + step, max_degree) - price(degree, max_degree);
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

//! One sweep over all edges. A flip that has changed the mesh around a vertex keeps others away from it.
void flip_sweep(EditMesh& mesh, Misfit& misfit, const MatchOptions& options, Random& random)
{
    std::vector<bool> changed(mesh.n_vertices(), false);
    for (const auto e : mesh.edges()) {
        const double chance = random.next();
        if (!may_flip(mesh, e)) {
            continue;
        }
        const Change change = flip_change(mesh, e);
        if (std::any_of(change.vertex.begin(), change.vertex.end(), [&](int v) { return changed[v]; })) {
            continue;
        }
        const double rise =
            misfit_change(misfit, change) + options.regularity * price_change(mesh, change, options.max_degree);
        if (rise >= 0 && chance >= std::exp(-rise / std::max(options.temperature, 1e-12))) {
            continue;
        }
        apply(change, misfit);
        mesh.flip(e);
        for (const int v : change.vertex) {
            changed[v] = true;
        }
    }
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

Misfit misfit_of(EditMesh& mesh, const MeshTree& target, const std::vector<double>& curvature)
{
    Misfit misfit;
    misfit.square = squared_inverse(mesh);
    misfit.residual = target_curvature(mesh, target, curvature);
    for (const auto v : mesh.vertices()) {
        misfit.residual[v.idx()] -= (6 - static_cast<int>(mesh.valence(v))) * quantum;
    }
    misfit.pull = misfit.square * misfit.residual;
    return misfit;
}

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

} // namespace

void relax_springs(TriangleMesh& triangles, const MeshTree& target, double edge, int sweeps)
{
    EditMesh mesh = edit_mesh(triangles);
    relax(mesh, target, edge, sweeps);
    triangles = triangle_mesh(mesh);
}

void match_curvature(TriangleMesh& triangles, const MeshTree& target, const MatchOptions& options)
{
    constexpr int flip_sweeps = 4;
    constexpr int relax_sweeps = 6;
    EditMesh mesh = edit_mesh(triangles);
    const std::vector<double> curvature = point_curvature(target.mesh());
    Random random(options.seed);
    MatchOptions now = options;
    for (int round = 0; round < options.rounds; ++round) {
        Misfit misfit = misfit_of(mesh, target, curvature);
        for (int sweep = 0; sweep < flip_sweeps; ++sweep) {
            flip_sweep(mesh, misfit, now, random);
        }
        now.temperature *= options.cooling;
        relax(mesh, target, options.edge, relax_sweeps);
    }
    triangles = triangle_mesh(mesh);
}

} // namespace rhombloom
