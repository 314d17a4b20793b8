#include "core/model/tagging.h"

#include <algorithm>
#include <queue>

namespace rhombloom {

namespace {

Side opposite(Side side)
{
    return side == Side::Long ? Side::Short : Side::Long;
}

std::vector<std::vector<int>> neighbours(int vertex_count, const std::vector<Quad>& quads)
{
    std::vector<std::vector<int>> result(vertex_count);
    for (const Quad& q : quads) {
        for (int i = 0; i < 4; ++i) {
            result[q[i]].push_back(q[(i + 1) % 4]);
            result[q[(i + 1) % 4]].push_back(q[i]);
        }
    }
    return result;
}

//! The two tree paths from a and b up to where they meet, closed by the edge a-b.
std::vector<int> cycle(const std::vector<int>& parent, int a, int b)
{
    std::vector<int> up_a = {a};
    while (parent[up_a.back()] >= 0) {
        up_a.push_back(parent[up_a.back()]);
    }
    std::vector<int> up_b;
    auto meeting = up_a.end();
    for (int v = b; (meeting = std::find(up_a.begin(), up_a.end(), v)) == up_a.end(); v = parent[v]) {
        up_b.push_back(v);
    }
    std::vector<int> result(up_a.begin(), meeting + 1);
    result.insert(result.end(), up_b.rbegin(), up_b.rend());
    return result;
}

std::string odd_cycle_message(const std::vector<int>& odd)
{
    std::string text = "long and short sides cannot alternate: the vertices";
    for (const int v : odd) {
        text += " " + std::to_string(v);
    }
    return text + " form a ring of " + std::to_string(odd.size()) +
           " edges, an odd number; change the handle or limb there so that the ring is even";
}

} // namespace

Expected<std::vector<Side>> tag_sides(int vertex_count, const std::vector<Quad>& quads, Side first)
{
    const auto adjacent = neighbours(vertex_count, quads);
    std::vector<Side> sides(vertex_count, first);
    std::vector<int> parent(vertex_count, -2); // -2 unseen, -1 root
    for (int root = 0; root < vertex_count; ++root) {
        if (parent[root] != -2) {
            continue;
        }
        parent[root] = -1;
        std::queue<int> frontier({root});
        while (!frontier.empty()) {
            const int v = frontier.front();
            frontier.pop();
            for (const int w : adjacent[v]) {
                if (parent[w] == -2) {
                    parent[w] = v;
                    sides[w] = opposite(sides[v]);
                    frontier.push(w);
                } else if (sides[w] == sides[v]) {
                    return refuse(odd_cycle_message(cycle(parent, v, w)));
                }
            }
        }
    }
    return sides;
}

} // namespace rhombloom
