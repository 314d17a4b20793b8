#include "core/design/mesh_import/mesh_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rhombloom {

namespace {

constexpr int leaf_size = 4;

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
    nodes_.reserve(order_.size());
    nodes_.emplace_back();
    build(0, 0, static_cast<int>(order_.size()));
}

void MeshTree::sum_up(Node& node, int first, int count) const
{
    double total = 0;
    for (int i = first; i < first + count; ++i) {
        const Triangle& t = mesh_.triangles[order_[i]];
        const Vec3 normal = area_normal(mesh_, t) / 2;
        node.dipole += normal;
        node.centre += normal.norm() * middles_[order_[i]];
        total += normal.norm();
        for (const int v : t) {
            node.box.extend(mesh_.points[v]);
        }
    }
    node.centre = total > 0 ? Vec3(node.centre / total) : Vec3(node.box.center());
    node.radius = (node.box.max() - node.centre).cwiseMax(node.centre - node.box.min()).norm();
}

void MeshTree::build(int index, int first, int count)
{
    sum_up(nodes_[index], first, count);
    if (count <= leaf_size) {
        nodes_[index].first = first;
        nodes_[index].count = count;
        return;
    }
    int axis = 0;
    nodes_[index].box.sizes().maxCoeff(&axis);
    const auto before = [&](int a, int b) { return std::pair(middles_[a][axis], a) < std::pair(middles_[b][axis], b); };
    const int half = count / 2;
    std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count, before);
    const int left = static_cast<int>(nodes_.size());
    nodes_[index].left = left;
    nodes_.emplace_back();
    nodes_.emplace_back();
    build(left, first, half);
    build(left + 1, first + half, count - half);
}

NearestPoint MeshTree::nearest(const Vec3& p) const
{
    NearestPoint best;
    double best_squared = std::numeric_limits<double>::infinity();
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
            const Triangle& t = mesh_.triangles[order_[i]];
            const Vec3 q = nearest_on_triangle(p, mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
            const double d = (q - p).squaredNorm();
            if (d < best_squared) {
                best_squared = d;
                best = {q, order_[i], 0};
            }
        }
        if (node.count == 0) {
            const double left = nodes_[node.left].box.squaredExteriorDistance(p);
            const double right = nodes_[node.left + 1].box.squaredExteriorDistance(p);
            const int nearer = left <= right ? 0 : 1;
            stack[size++] = {std::max(left, right), node.left + 1 - nearer};
            stack[size++] = {std::min(left, right), node.left + nearer};
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
        const Node& node = nodes_[stack[--size]];
        const Vec3 r = node.centre - p;
        const double distance = r.norm();
        if (distance > far * node.radius) {
            sum += node.dipole.dot(r) / (distance * distance * distance);
            continue;
        }
        for (int i = node.first; i < node.first + node.count; ++i) {
            const Triangle& t = mesh_.triangles[order_[i]];
            sum += solid_angle(p, mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
        }
        if (node.count == 0) {
            stack[size++] = node.left;
            stack[size++] = node.left + 1;
        }
    }
    return sum / (2 * two_pi);
}

} // namespace rhombloom
