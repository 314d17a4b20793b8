#include "core/design/mesh_import/mesh_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/form/parallel.h"

namespace rhombloom {

namespace {

constexpr int leaf_size = 4;

//! Nodes of a tree over \p count triangles. Every level has nodes of two sizes, one apart.
int tree_size(int count)
{
    int nodes = 0;
    int small = 1; // nodes of this size
    int large = 0; // of one more
    int size = count;
    for (; size > leaf_size; size /= 2) {
        nodes += small + large;
        (size % 2 == 0 ? small : large) += small + large;
    }
    return nodes + small + (size < leaf_size ? large : 3 * large);
}

//! As Eigen's squaredExteriorDistance(), without branches that cannot be predicted.
double squared_distance(const Eigen::AlignedBox3d& box, const Vec3& p)
{
    return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0.0).squaredNorm();
}

//! Solid angle of a triangle as seen from p (Van Oosterom and Strackee 1983).
double solid_angle(const Vec3& p, const Vec3& a0, const Vec3& b0, const Vec3& c0)
{
    const Vec3 a = a0 - p;
    const Vec3 b = b0 - p;
    const Vec3 c = c0 - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    return 2 * std::atan2(a.dot(b.cross(c)), denominator);
}

} // namespace

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
    // Which of the seven regions (corners, sides, inside) p projects to, by barycentric signs.
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = ab.dot(p - a);
    const double d2 = ac.dot(p - a);
    if (d1 <= 0 && d2 <= 0) {
        return a;
    }
    const double d3 = ab.dot(p - b);
    const double d4 = ac.dot(p - b);
    if (d3 >= 0 && d4 <= d3) {
        return b;
    }
    const double d5 = ab.dot(p - c);
    const double d6 = ac.dot(p - c);
    if (d6 >= 0 && d5 <= d6) {
        return c;
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        return a + ab * (d1 / (d1 - d3));
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        return a + ac * (d2 / (d2 - d6));
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    const double sum = va + vb + vc;
    return sum > 0 ? Vec3(a + ab * (vb / sum) + ac * (vc / sum)) : a;
}

MeshTree::MeshTree(TriangleMesh mesh) : mesh_(std::move(mesh)), order_(mesh_.triangles.size())
{
    expects(!mesh_.triangles.empty(), "MeshTree: the mesh has a triangle");
    std::iota(order_.begin(), order_.end(), 0);
    normals_.reserve(order_.size());
    middles_.reserve(order_.size());
    for (const Triangle& t : mesh_.triangles) {
        const Vec3 normal = area_normal(mesh_, t);
        normals_.push_back(normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3(Vec3::Zero()));
        middles_.emplace_back((mesh_.points[t[0]] + mesh_.points[t[1]] + mesh_.points[t[2]]) / 3);
    }
    const int count = static_cast<int>(order_.size());
    nodes_.resize(tree_size(count));
    dipoles_.resize(nodes_.size());
    constexpr int many = 100'000; // triangles: threads pay
    build(0, 0, count, 1, count < many ? 1 : default_threads());
    corners_.reserve(order_.size());
    for (const int k : order_) {
        const Triangle& t = mesh_.triangles[k];
        corners_.push_back({mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]});
    }
}

//! A leaf; the centre of its dipole is still a sum, which build() divides by the area.
void MeshTree::make_leaf(int index, int first, int count)
{
    Node& node = nodes_[index];
    Dipole& dipole = dipoles_[index];
    node.first = first;
    node.count = count;
    for (int i = first; i < first + count; ++i) {
        const Triangle& t = mesh_.triangles[order_[i]];
        const Vec3 normal = area_normal(mesh_, t) / 2;
        const double area = normal.norm();
        dipole.moment += normal;
        dipole.centre += area * middles_[order_[i]];
        dipole.area += area;
    }
}

//! The dipole of an inner node, after its children; its centre too is still a sum.
void MeshTree::sum_up(int index)
{
    const Node& node = nodes_[index];
    Dipole& dipole = dipoles_[index];
    for (const int child : {node.left, node.left + 1}) {
        const Dipole& part = dipoles_[child];
        dipole.moment += part.moment;
        dipole.centre += part.area * part.centre;
        dipole.area += part.area;
    }
}

//! \param left Where the node's children and all below them are put.
void MeshTree::build(int index, int first, int count, int left, int threads)
{
    Eigen::AlignedBox3d box;
    for (int i = first; i < first + count; ++i) {
        for (const int v : mesh_.triangles[order_[i]]) {
            box.extend(mesh_.points[v]);
        }
    }
    nodes_[index].box = box;
    if (count <= leaf_size) {
        make_leaf(index, first, count);
    } else {
        int axis = 0;
        box.sizes().maxCoeff(&axis);
        const auto before = [&](int a, int b) {
            return std::pair(middles_[a][axis], a) < std::pair(middles_[b][axis], b);
        };
        const int half = count / 2;
        std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count, before);
        nodes_[index].left = left;
        const auto build_child = [&](int k) {
            if (k == 0) {
                build(left, first, half, left + 2, threads / 2);
            } else {
                build(left + 1, first + half, count - half, left + 1 + tree_size(half), threads - threads / 2);
            }
        };
        if (threads > 1) {
            parallel_tasks(2, 2, build_child);
        } else {
            build_child(0);
            build_child(1);
        }
        sum_up(index);
    }
    Dipole& dipole = dipoles_[index];
    dipole.centre = dipole.area > 0 ? Vec3(dipole.centre / dipole.area) : Vec3(box.center());
    dipole.radius = (box.max() - dipole.centre).cwiseMax(dipole.centre - box.min()).norm();
}

void MeshTree::transform(double factor, const Vec3& shift)
{
    expects(factor > 0, "MeshTree::transform: the factor is positive");
    const auto moved = [&](const Vec3& p) -> Vec3 { return factor * p + shift; };
    rhombloom::transform(mesh_, factor, shift);
    std::transform(middles_.begin(), middles_.end(), middles_.begin(), moved);
    for (std::array<Vec3, 3>& corners : corners_) {
        std::transform(corners.begin(), corners.end(), corners.begin(), moved);
    }
    for (Node& node : nodes_) {
        node.box = Eigen::AlignedBox3d(moved(node.box.min()), moved(node.box.max()));
    }
    for (Dipole& dipole : dipoles_) {
        dipole.moment *= factor * factor;
        dipole.centre = moved(dipole.centre);
        dipole.area *= factor * factor;
        dipole.radius *= factor;
    }
}

NearestPoint MeshTree::nearest(const Vec3& p, int hint) const
{
    NearestPoint best;
    double best_squared = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Vec3& a, const Vec3& b, const Vec3& c, int triangle) {
        const Vec3 q = nearest_on_triangle(p, a, b, c);
        const double d = (q - p).squaredNorm();
        if (d < best_squared) {
            best_squared = d;
            best = {q, triangle, 0};
        }
    };
    if (hint >= 0) {
        const Triangle& t = mesh_.triangles[hint];
        consider(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]], hint);
    }
    std::array<std::pair<double, int>, 128> stack;
    int size = 0;
    stack[size++] = {0, 0};
    while (size > 0) {
        const auto [squared, index] = stack[--size];
        if (squared >= best_squared) {
            continue;
        }
        const Node& node = nodes_[index];
        for (int i = node.first; i < node.first + node.count; ++i) {
            const auto& [a, b, c] = corners_[i];
            consider(a, b, c, order_[i]);
        }
        if (node.count == 0) {
            const double left = squared_distance(nodes_[node.left].box, p);
            const double right = squared_distance(nodes_[node.left + 1].box, p);
            const int nearer = left <= right ? 0 : 1;
            for (const auto& [off, child] : {std::pair(std::max(left, right), node.left + 1 - nearer),
                                             std::pair(std::min(left, right), node.left + nearer)}) {
                if (off < best_squared) {
                    stack[size++] = {off, child};
                }
            }
        }
    }
    best.distance = std::sqrt(best_squared);
    return best;
}

double MeshTree::winding_number(const Vec3& p) const
{
    constexpr double far = 2.5; // radii from which a group of triangles counts as one dipole
    double sum = 0;
    std::array<int, 128> stack;
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const int index = stack[--size];
        const Node& node = nodes_[index];
        const Dipole& dipole = dipoles_[index];
        const Vec3 r = dipole.centre - p;
        const double distance = r.norm();
        if (distance > far * dipole.radius) {
            sum += dipole.moment.dot(r) / (distance * distance * distance);
            continue;
        }
        for (int i = node.first; i < node.first + node.count; ++i) {
            const auto& [a, b, c] = corners_[i];
            sum += solid_angle(p, a, b, c);
        }
        if (node.count == 0) {
            stack[size++] = node.left;
            stack[size++] = node.left + 1;
        }
    }
    return sum / (2 * two_pi);
}

} // namespace rhombloom
