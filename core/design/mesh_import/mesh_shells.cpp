#include "core/design/mesh_import/mesh_shells.h"

#include <algorithm>
#include <numeric>

namespace rhombloom {

namespace {

//! One side of a triangle, under the undirected edge it belongs to.
struct EdgeUse
{
    int low = 0;
    int high = 0;
    int triangle = 0;
    bool forward = false; //!< the triangle runs from low to high

    bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

//! By their lower ends, then their higher ends, then their triangles.
std::vector<EdgeUse> sorted_edges(const TriangleMesh& mesh)
{
    std::vector<std::size_t> end(mesh.points.size(), 0); // of the uses with each lower end, after they are counted
    const auto for_uses = [&](auto&& take) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            for (int k = 0; k < 3; ++k) {
                const int a = mesh.triangles[i][k];
                const int b = mesh.triangles[i][(k + 1) % 3];
                take(EdgeUse{std::min(a, b), std::max(a, b), static_cast<int>(i), a < b});
            }
        }
    };
    for_uses([&](const EdgeUse& use) { ++end[use.low]; });
    std::exclusive_scan(end.begin(), end.end(), end.begin(), std::size_t(0));
    std::vector<EdgeUse> uses(3 * mesh.triangles.size());
    for_uses([&](const EdgeUse& use) { uses[end[use.low]++] = use; });
    auto first = uses.begin();
    for (const std::size_t last : end) {
        std::sort(first, uses.begin() + static_cast<std::ptrdiff_t>(last), [](const EdgeUse& a, const EdgeUse& b) {
            return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle);
        });
        first = uses.begin() + static_cast<std::ptrdiff_t>(last);
    }
    return uses;
}

//! The neighbour over one side of a triangle: -1 none. `agrees`: both run through the edge in opposite directions.
struct Neighbour
{
    int triangle = -1;
    bool agrees = true;
};

using Neighbours = std::vector<std::array<Neighbour, 3>>;

Neighbours neighbours(const TriangleMesh& mesh, Shells& shells)
{
    const std::vector<EdgeUse> uses = sorted_edges(mesh);
    Neighbours result(mesh.triangles.size());
    std::vector<int> known(mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t end = i;
        while (end < uses.size() && uses[end].same_edge(uses[i])) {
            ++end;
        }
        shells.boundary_edges += end - i == 1 ? 1 : 0;
        shells.crowded_edges += end - i > 2 ? 1 : 0;
        if (end - i == 2) {
            const EdgeUse& a = uses[i];
            const EdgeUse& b = uses[i + 1];
            result[a.triangle][known[a.triangle]++] = {b.triangle, a.forward != b.forward};
            result[b.triangle][known[b.triangle]++] = {a.triangle, a.forward != b.forward};
        }
        i = end;
    }
    return result;
}

void turn(Triangle& t)
{
    std::swap(t[1], t[2]);
}

//! Walk over one shell from \p seed; returns false when it is one-sided.
bool orient_from(int seed, const Neighbours& adjacent, std::vector<bool>& turned, Shells& shells)
{
    bool two_sided = true;
    std::vector<int> stack = {seed};
    shells.shell[seed] = shells.count;
    while (!stack.empty()) {
        const int t = stack.back();
        stack.pop_back();
        for (const Neighbour& n : adjacent[t]) {
            if (n.triangle < 0) {
                continue;
            }
            const bool wanted = turned[t] == n.agrees;
            if (shells.shell[n.triangle] < 0) {
                shells.shell[n.triangle] = shells.count;
                turned[n.triangle] = wanted;
                stack.push_back(n.triangle);
            } else if (turned[n.triangle] != wanted) {
                two_sided = false;
            }
        }
    }
    return two_sided;
}

//! The volume of each shell, as if closed, seen from its own middle.
std::vector<double> volumes(const TriangleMesh& mesh, const Shells& shells)
{
    std::vector<Vec3> anchor(shells.count, Vec3::Zero());
    for (std::size_t i = mesh.triangles.size(); i-- > 0;) {
        anchor[shells.shell[i]] = mesh.points[mesh.triangles[i][0]];
    }
    std::vector<double> result(shells.count, 0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        const Vec3& o = anchor[shells.shell[i]];
        result[shells.shell[i]] +=
            (mesh.points[t[0]] - o).dot((mesh.points[t[1]] - o).cross(mesh.points[t[2]] - o)) / 6;
    }
    return result;
}

} // namespace

Shells orient_shells(TriangleMesh& mesh)
{
    Shells shells;
    shells.shell.assign(mesh.triangles.size(), -1);
    const Neighbours adjacent = neighbours(mesh, shells);
    std::vector<bool> turned(mesh.triangles.size(), false);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (shells.shell[i] < 0) {
            shells.one_sided.push_back(!orient_from(static_cast<int>(i), adjacent, turned, shells));
            ++shells.count;
        }
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (turned[i]) {
            turn(mesh.triangles[i]);
        }
    }
    const std::vector<double> volume = volumes(mesh, shells);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (volume[shells.shell[i]] < 0) {
            turn(mesh.triangles[i]);
        }
    }
    return shells;
}

int split_fans(TriangleMesh& mesh)
{
    // Corners of one fan are joined over the edges their triangles share: a union-find over corners.
    std::vector<int> parent(3 * mesh.triangles.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&](int c) {
        while (parent[c] != c) {
            c = parent[c] = parent[parent[c]];
        }
        return c;
    };
    const auto corner = [&](int triangle, int vertex) {
        const Triangle& t = mesh.triangles[triangle];
        return 3 * triangle + static_cast<int>(std::find(t.begin(), t.end(), vertex) - t.begin());
    };
    const std::vector<EdgeUse> uses = sorted_edges(mesh);
    for (std::size_t i = 1; i < uses.size(); ++i) {
        if (uses[i].same_edge(uses[i - 1])) {
            for (const int v : {uses[i].low, uses[i].high}) {
                parent[find(corner(uses[i].triangle, v))] = find(corner(uses[i - 1].triangle, v));
            }
        }
    }
    std::vector<int> fan_of(mesh.points.size(), -1);
    std::vector<int> own_point(parent.size(), -1);
    int added = 0;
    for (int c = 0; c < static_cast<int>(parent.size()); ++c) {
        int& v = mesh.triangles[c / 3][c % 3];
        const int root = find(c);
        if (own_point[root] < 0) {
            const bool first = fan_of[v] < 0;
            own_point[root] = first ? v : static_cast<int>(mesh.points.size());
            if (first) {
                fan_of[v] = root;
            } else {
                const Vec3 p = mesh.points[v];
                mesh.points.push_back(p);
                ++added;
            }
        }
        v = own_point[root];
    }
    return added;
}

std::vector<std::vector<int>> boundary_rings(const TriangleMesh& mesh)
{
    const std::vector<EdgeUse> uses = sorted_edges(mesh);
    std::vector<int> next(mesh.points.size(), -1);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        const bool shared =
            (i > 0 && uses[i].same_edge(uses[i - 1])) || (i + 1 < uses.size() && uses[i].same_edge(uses[i + 1]));
        if (!shared) {
            next[uses[i].forward ? uses[i].low : uses[i].high] = uses[i].forward ? uses[i].high : uses[i].low;
        }
    }
    std::vector<std::vector<int>> rings;
    for (int v = 0; v < static_cast<int>(next.size()); ++v) {
        std::vector<int> ring;
        for (int w = v; w >= 0 && next[w] >= 0;) {
            ring.push_back(w);
            const int follower = next[w];
            next[w] = -1;
            w = follower;
        }
        if (ring.size() >= 3) {
            rings.push_back(std::move(ring));
        }
    }
    return rings;
}

} // namespace rhombloom
