#include <algorithm>
#include <numeric>

#include "core/form/linear_factor.h"

namespace rhombloom {

namespace {

constexpr double smallest_parallel_work = 2e7; // multiplications; below, starting a thread costs more than it brings
constexpr int parts = 8;                       // of the work; the same for any number of threads, for the same sums

} // namespace

LinearSolver::Factor::Factor(const BlockMatrix& matrix, int thread_count)
    : pattern_start(matrix.start), pattern_row(matrix.row), tree(elimination_tree(matrix)), threads(thread_count)
{
    std::size_t size = 0;
    children.resize(tree.fronts.size());
    for (std::size_t f = 0; f < tree.fronts.size(); ++f) {
        shapes.emplace_back(tree.fronts[f]);
        panel_offset.push_back(size);
        size += shapes.back().panel_size();
        if (tree.fronts[f].parent >= 0) {
            children[tree.fronts[f].parent].push_back(static_cast<int>(f));
        }
    }
    panels.resize(size);
    update.assign(tree.fronts.size(), nullptr);
    find_targets(matrix);
    split_into_tasks();
    find_places();
}

void LinearSolver::Factor::find_targets(const BlockMatrix& matrix)
{
    std::vector<std::vector<std::pair<int, std::size_t>>> blocks_of_column(matrix.size); // (position of row, block)
    std::vector<bool> transposed(matrix.row.size());
    for (int j = 0; j < matrix.size; ++j) {
        for (int k = matrix.start[j]; k < matrix.start[j + 1]; ++k) {
            const int a = tree.position[matrix.row[k]];
            const int b = tree.position[j];
            transposed[k] = a < b;
            blocks_of_column[std::min(a, b)].emplace_back(std::max(a, b), k);
        }
    }
    for (std::size_t f = 0; f < tree.fronts.size(); ++f) {
        const Front& front = tree.fronts[f];
        first_target.push_back(targets.size());
        for (int j = front.first; j < front.last; ++j) {
            for (const auto& [row, block] : blocks_of_column[j]) {
                int local = 3 * (row - front.first);
                if (row >= front.last) {
                    const auto found = std::lower_bound(front.rows.begin(), front.rows.end(), row);
                    local = strip * shapes[f].diagonal_strips + 3 * static_cast<int>(found - front.rows.begin());
                }
                const std::size_t column = panel_offset[f] + std::size_t(strip) * 3 * (j - front.first);
                targets.push_back({block,
                                   {column + panel_row(shapes[f], local), column + panel_row(shapes[f], local + 1),
                                    column + panel_row(shapes[f], local + 2)},
                                   transposed[block],
                                   row == j});
            }
        }
    }
    first_target.push_back(targets.size());
}

// Subtrees of at most an eighth of the work become tasks of their own.
void LinearSolver::Factor::split_into_tasks()
{
    const int n = static_cast<int>(tree.fronts.size());
    std::vector<double> work(n);
    std::vector<int> first(n); // of the subtree
    for (int f = 0; f < n; ++f) {
        work[f] = shapes[f].work();
        first[f] = children[f].empty() ? f : first[children[f].front()];
        for (const int child : children[f]) {
            work[f] += work[child];
        }
    }
    const double total = total_work();
    const double largest = total > smallest_parallel_work ? total / parts : 2 * total;
    for (int f = n - 1; f >= 0;) {
        if (work[f] > largest) {
            top.fronts.push_back(f--);
        } else {
            std::vector<int> fronts(f + 1 - first[f]);
            std::iota(fronts.begin(), fronts.end(), first[f]);
            subtrees.push_back({std::move(fronts), {}});
            f = first[f] - 1;
        }
    }
    std::reverse(top.fronts.begin(), top.fronts.end());
    largest_first.resize(subtrees.size());
    std::iota(largest_first.begin(), largest_first.end(), 0);
    std::stable_sort(largest_first.begin(), largest_first.end(),
                     [&](int a, int b) { return work[subtrees[a].fronts.back()] > work[subtrees[b].fronts.back()]; });
    for (Task& task : subtrees) {
        task.stack.resize(stack_size(task.fronts));
    }
    top.stack.resize(stack_size(top.fronts));
}

// A subtree sees the rows of the fronts above it, which are among those of its root, at places of its own.
void LinearSolver::Factor::find_places()
{
    for (const Front& front : tree.fronts) {
        places.push_back(front.rows);
    }
    place_count = static_cast<int>(tree.order.size());
    for (Task& task : subtrees) {
        task.first_outer = place_count;
        const std::vector<int>& outer = outer_rows(task);
        const int end = tree.fronts[task.fronts.back()].last;
        for (const int f : task.fronts) {
            for (int& row : places[f]) {
                if (row >= end) {
                    row = place_count + int(std::lower_bound(outer.begin(), outer.end(), row) - outer.begin());
                }
            }
        }
        place_count += static_cast<int>(outer.size());
    }
}

// Largest fill of the stack: a front's update is built above those of its children, then moved down onto them.
std::size_t LinearSolver::Factor::stack_size(const std::vector<int>& fronts) const
{
    std::size_t now = 0;
    std::size_t peak = 0;
    std::vector<bool> inside(tree.fronts.size(), false);
    for (const int f : fronts) {
        inside[f] = true;
        now += shapes[f].update_size();
        peak = std::max(peak, now);
        for (const int child : children[f]) {
            now -= inside[child] ? shapes[child].update_size() : 0;
        }
    }
    return peak;
}

double LinearSolver::Factor::total_work() const
{
    return std::accumulate(shapes.begin(), shapes.end(), 0.0,
                           [](double sum, const FrontShape& shape) { return sum + shape.work(); });
}

} // namespace rhombloom
