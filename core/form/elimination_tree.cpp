#include "core/form/elimination_tree.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <metis.h>

#include "core/expected.h"

namespace rhombloom {

namespace {

constexpr int smallest_dissection = 500; // block rows; below, minimum degree orders faster than it costs

// Neighbours of every block row, without the row itself.
struct Graph
{
    std::vector<int> start;
    std::vector<int> neighbour;
};

Graph graph_of(const BlockMatrix& matrix)
{
    Graph graph;
    graph.start.assign(matrix.size + 1, 0);
    const auto for_each_pair = [&](auto&& action) {
        for (int j = 0; j < matrix.size; ++j) {
            for (int k = matrix.start[j] + 1; k < matrix.start[j + 1]; ++k) {
                action(matrix.row[k], j);
                action(j, matrix.row[k]);
            }
        }
    };
    for_each_pair([&](int i, int) { ++graph.start[i + 1]; });
    std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
    graph.neighbour.resize(graph.start.back());
    std::vector<int> next(graph.start.begin(), graph.start.end() - 1);
    for_each_pair([&](int i, int j) { graph.neighbour[next[i]++] = j; });
    return graph;
}

std::vector<int> dissection_order(Graph graph, int size)
{
    static std::mutex one_at_a_time; // METIS draws from the C library's generator
    const std::lock_guard lock(one_at_a_time);
    std::vector<int> order(size);
    std::vector<int> position(size);
    const int status = METIS_NodeND(&size, graph.start.data(), graph.neighbour.data(), nullptr, nullptr, order.data(),
                                    position.data());
    expects(status == METIS_OK, "METIS_NodeND: a valid graph and enough memory");
    return order;
}

std::vector<int> minimum_degree_order(const BlockMatrix& matrix)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < matrix.size; ++j) {
        for (int k = matrix.start[j]; k < matrix.start[j + 1]; ++k) {
            entries.emplace_back(matrix.row[k], j, 1.0);
            entries.emplace_back(j, matrix.row[k], 1.0);
        }
    }
    Eigen::SparseMatrix<double> pattern(matrix.size, matrix.size);
    pattern.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(pattern, permutation);
    const auto& indices = permutation.indices();
    return {indices.begin(), indices.end()};
}

std::vector<int> inverse(const std::vector<int>& order)
{
    std::vector<int> position(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        position[order[k]] = static_cast<int>(k);
    }
    return position;
}

// The elimination forest over columns, and the number of entries below the diagonal of every column of the factor.
struct ColumnTree
{
    std::vector<int> parent;
    std::vector<int> count;
};

ColumnTree column_tree(const Graph& graph, const std::vector<int>& order, const std::vector<int>& position)
{
    const int n = static_cast<int>(order.size());
    ColumnTree tree{std::vector<int>(n, -1), std::vector<int>(n, 0)};
    std::vector<int> seen(n, -1);
    for (int i = 0; i < n; ++i) {
        seen[i] = i;
        const int v = order[i];
        for (int k = graph.start[v]; k < graph.start[v + 1]; ++k) {
            // Walk the row's subtree: every column between an entry and the row has a fill entry in it.
            for (int j = position[graph.neighbour[k]]; j < i && seen[j] != i; j = tree.parent[j]) {
                if (tree.parent[j] == -1) {
                    tree.parent[j] = i;
                }
                ++tree.count[j];
                seen[j] = i;
            }
        }
    }
    return tree;
}

// Children before parents, subtrees contiguous, the child with the longest column last: it can join its parent.
std::vector<int> postorder(const ColumnTree& tree)
{
    const int n = static_cast<int>(tree.parent.size());
    std::vector<std::vector<int>> children(n + 1); // of n: the roots
    for (int j = 0; j < n; ++j) {
        children[tree.parent[j] < 0 ? n : tree.parent[j]].push_back(j);
    }
    for (std::vector<int>& list : children) {
        std::stable_sort(list.begin(), list.end(), [&](int a, int b) { return tree.count[a] < tree.count[b]; });
    }
    std::vector<int> order;
    std::vector<std::pair<int, std::size_t>> stack = {{n, 0}};
    while (!stack.empty()) {
        auto& [node, next] = stack.back();
        if (next < children[node].size()) {
            const int child = children[node][next++];
            stack.emplace_back(child, 0);
        } else {
            order.push_back(node);
            stack.pop_back();
        }
    }
    order.pop_back(); // the artificial root
    return order;
}

// A supernode in the making: columns [first, last) with `below` rows under them, `zeros` of its entries being padding.
struct Supernode
{
    int first;
    int last;
    int below;
    double zeros;

    double entries() const
    {
        const double columns = last - first;
        return columns * (columns + 1) / 2 + columns * below;
    }
};

bool worth_joining(const Supernode& joined)
{
    const int columns = joined.last - joined.first;
    const double share = joined.zeros / joined.entries();
    return columns <= 4 ? share < 0.6 : columns <= 12 ? share < 0.25 : columns <= 32 ? share < 0.1 : share < 0.03;
}

std::vector<Supernode> supernodes(const ColumnTree& tree)
{
    std::vector<Supernode> done;
    const int n = static_cast<int>(tree.parent.size());
    for (int j = 0; j < n; ++j) {
        Supernode node{j, j + 1, tree.count[j], 0};
        // Columns with the same rows first, then relaxed: the child that ends where this one begins.
        while (!done.empty() && tree.parent[done.back().last - 1] >= node.first &&
               tree.parent[done.back().last - 1] < node.last) {
            const Supernode& child = done.back();
            const double missing =
                (child.last - child.first) * double(node.last - node.first + node.below - child.below);
            const Supernode joined{child.first, node.last, node.below, child.zeros + node.zeros + missing};
            if (missing > 0 && !worth_joining(joined)) {
                break;
            }
            node = joined;
            done.pop_back();
        }
        done.push_back(node);
    }
    return done;
}

void collect_rows(std::vector<Front>& fronts, const Graph& graph, const EliminationTree& tree)
{
    std::vector<int> front_of(tree.order.size());
    std::vector<std::vector<int>> children(fronts.size());
    std::vector<int> seen(tree.order.size(), -1);
    for (std::size_t f = 0; f < fronts.size(); ++f) {
        std::fill(front_of.begin() + fronts[f].first, front_of.begin() + fronts[f].last, static_cast<int>(f));
    }
    for (int f = 0; f < static_cast<int>(fronts.size()); ++f) {
        Front& front = fronts[f];
        const auto add = [&](int row) {
            if (row >= front.last && seen[row] != f) {
                seen[row] = f;
                front.rows.push_back(row);
            }
        };
        for (int j = front.first; j < front.last; ++j) {
            const int v = tree.order[j];
            for (int k = graph.start[v]; k < graph.start[v + 1]; ++k) {
                add(tree.position[graph.neighbour[k]]);
            }
        }
        for (const int child : children[f]) {
            std::for_each(fronts[child].rows.begin(), fronts[child].rows.end(), add);
        }
        std::sort(front.rows.begin(), front.rows.end());
        if (!front.rows.empty()) {
            front.parent = front_of[front.rows.front()];
            children[front.parent].push_back(f);
        }
    }
}

} // namespace

std::vector<int> fill_reducing_order(const BlockMatrix& matrix)
{
    return matrix.size < smallest_dissection ? minimum_degree_order(matrix)
                                             : dissection_order(graph_of(matrix), matrix.size);
}

EliminationTree elimination_tree(const BlockMatrix& matrix)
{
    const Graph graph = graph_of(matrix);
    EliminationTree tree;
    tree.order = fill_reducing_order(matrix);
    tree.position = inverse(tree.order);
    const std::vector<int> post = postorder(column_tree(graph, tree.order, tree.position));
    std::vector<int> order(post.size());
    std::transform(post.begin(), post.end(), order.begin(), [&](int j) { return tree.order[j]; });
    tree.order = order;
    tree.position = inverse(order);
    for (const Supernode& node : supernodes(column_tree(graph, tree.order, tree.position))) {
        tree.fronts.push_back({node.first, node.last, -1, {}});
    }
    collect_rows(tree.fronts, graph, tree);
    return tree;
}

} // namespace rhombloom
