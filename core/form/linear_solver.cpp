#include "core/form/linear_solver.h"

#include <algorithm>
#include <mutex>

#include "core/form/dense_kernels.h"
#include "core/form/linear_factor.h"
#include "core/form/parallel.h"

namespace rhombloom {

namespace {

constexpr int smallest_shared = 24;  // strips that two threads share
constexpr int columns_at_once = 128; // of a front that several threads factor

// A strip of a child's update on its way to the front of its parent.
struct Scatter
{
    const double* from;
    const int* column; // offset of each column's place in a row
    int first;         // row
    int count;         // of rows

    // Add the columns [begin, end) to the rows that begin at \p rows, as far as they are in the lower triangle.
    void add(int begin, int end, double* const* rows) const
    {
        const int whole = std::min(end, first);
        for (int j = begin; j < whole; ++j) {
            for (int i = 0; i < count; ++i) {
                rows[first + i][column[j]] += from[strip * j + i];
            }
        }
        for (int j = std::max(begin, first); j < std::min(end, first + count); ++j) {
            for (int i = j - first; i < count; ++i) {
                rows[first + i][column[j]] += from[strip * j + i];
            }
        }
    }
};

// Call action(first, last) for parts of the strips of a lower triangle, the longest first, on so many threads.
template <class Action>
void for_parts(int helpers, int strips, const Action& action)
{
    const int parts = helpers == 1 || strips < smallest_shared ? 1 : strips / 8;
    parallel_tasks(helpers, parts, [&](int part) {
        const int p = parts - 1 - part;
        action(strips * p / parts, strips * (p + 1) / parts);
    });
}

} // namespace

void LinearSolver::Factor::assemble_matrix(const BlockMatrix& matrix, double shift, int f)
{
    double* panel = panels.data();
    std::fill_n(panel + panel_offset[f], shapes[f].panel_size(), 0.0);
    for (std::size_t t = first_target[f]; t < first_target[f + 1]; ++t) {
        const BlockTarget& target = targets[t];
        const double* block = &matrix.value[9 * target.block];
        for (int i = 0; i < 3; ++i) {
            double* row = panel + target.row[i];
            for (int j = 0; j < 3; ++j) {
                row[strip * j] = target.transposed ? block[3 * i + j] : block[3 * j + i];
            }
            row[strip * i] += target.diagonal ? shift : 0;
        }
    }
}

// Extend-add: the child's update goes to the front's pivot columns and to its own update.
void LinearSolver::Factor::assemble_child(int f, int child, double* update_matrix, int helpers)
{
    const Front& front = tree.fronts[f];
    const std::vector<int>& rows = tree.fronts[child].rows;
    const int n = 3 * static_cast<int>(rows.size());
    std::vector<double*> in_panel(n);
    std::vector<double*> in_update(n);
    std::vector<int> column(n); // offset of what begins a column
    int pivot_columns = 0;
    std::size_t k = 0;
    for (int b = 0; b < static_cast<int>(rows.size()); ++b) {
        const bool pivot = rows[b] < front.last;
        while (!pivot && front.rows[k] != rows[b]) {
            ++k;
        }
        for (int i = 0; i < 3; ++i) {
            const int r = 3 * b + i;
            const int local = pivot ? 3 * (rows[b] - front.first) + i : 3 * static_cast<int>(k) + i;
            const int row = pivot ? local : strip * shapes[f].diagonal_strips + local;
            column[r] = strip * local;
            in_panel[r] = panels.data() + panel_offset[f] + panel_row(shapes[f], row);
            in_update[r] = pivot ? nullptr : update_matrix + update_row(local);
            pivot_columns += pivot;
        }
    }
    for_parts(helpers, strip_count(n), [&](int first, int last) {
        for (int s = first; s < last; ++s) {
            const double* from = update[child] + update_row(strip * s);
            const Scatter scatter{from, column.data(), strip * s, std::min(strip, n - strip * s)};
            scatter.add(0, pivot_columns, in_panel.data());
            scatter.add(pivot_columns, n, in_update.data());
        }
    });
}

// Cholesky's columns of the front, so many at a time; the rows below their pivots side by side.
bool LinearSolver::Factor::factor_panel(int f, int helpers)
{
    const FrontShape& shape = shapes[f];
    double* panel = panels.data() + panel_offset[f];
    if (helpers == 1) {
        return dense_kernels().factor(panel, shape.columns, 0, shape.columns, shape.strips, nullptr);
    }
    std::vector<double> inverse(shape.columns);
    for (int first = 0; first < shape.columns; first += columns_at_once) {
        const int last = std::min(first + columns_at_once, shape.columns);
        const int done = strip_count(last);
        if (!dense_kernels().factor(panel, shape.columns, first, last, done, inverse.data())) {
            return false;
        }
        const int below = shape.strips - done;
        const int chunks = below < smallest_shared ? 1 : 2 * helpers;
        parallel_tasks(helpers, chunks, [&](int c) {
            dense_kernels().factor_rows(panel, shape.columns, first, last, inverse.data(), done + below * c / chunks,
                                        done + below * (c + 1) / chunks);
        });
    }
    return true;
}

void LinearSolver::Factor::subtract_update(int f, double* update_matrix, int helpers) const
{
    const FrontShape& shape = shapes[f];
    const int strips = shape.strips - shape.diagonal_strips;
    const double* below = panels.data() + panel_offset[f] + std::size_t(strip) * shape.columns * shape.diagonal_strips;
    for_parts(helpers, strips,
              [&](int first, int last) { dense_kernels().update(below, shape.columns, update_matrix, first, last); });
}

bool LinearSolver::Factor::factor_fronts(const BlockMatrix& matrix, double shift, const std::vector<int>& fronts,
                                         double* stack, int helpers, const std::atomic<bool>& failed)
{
    double* stack_top = stack;
    for (const int f : fronts) {
        if (failed) {
            return false;
        }
        const FrontShape& shape = shapes[f];
        double* own = stack_top;
        double* bottom = own;
        std::fill_n(own, shape.update_size(), 0.0);
        assemble_matrix(matrix, shift, f);
        for (const int child : children[f]) {
            assemble_child(f, child, own, helpers);
            if (update[child] >= stack && update[child] < own) {
                bottom = std::min(bottom, update[child]);
            }
        }
        if (!factor_panel(f, helpers)) {
            return false;
        }
        subtract_update(f, own, helpers);
        std::copy_n(own, shape.update_size(), bottom); // downwards: the ranges may overlap
        update[f] = bottom;
        stack_top = bottom + shape.update_size();
    }
    return true;
}

// Symbolic factorisations that nobody uses at the moment, with their memory. While a surface is dragged its
// connectivity stays the same, and to order its matrix costs as much as two or three steps of Newton's method.
class LinearSolver::Shelf
{
public:
    Shelf() { factors_.reserve(most_kept); }

    std::unique_ptr<Factor> take(const BlockMatrix& matrix, int threads)
    {
        const std::lock_guard lock(mutex_);
        const auto found = std::find_if(factors_.begin(), factors_.end(), [&](const std::unique_ptr<Factor>& f) {
            return f->threads == threads && f->pattern_start == matrix.start && f->pattern_row == matrix.row;
        });
        if (found == factors_.end()) {
            return nullptr;
        }
        std::unique_ptr<Factor> factor = std::move(*found);
        factors_.erase(found);
        return factor;
    }

    void keep(std::unique_ptr<Factor> factor)
    {
        if (factor->panels.size() > largest_kept) {
            return;
        }
        const std::lock_guard lock(mutex_);
        if (factors_.size() == most_kept) {
            factors_.erase(factors_.begin()); // the one that was used least recently
        }
        factors_.push_back(std::move(factor));
    }

private:
    static constexpr std::size_t most_kept = 4;
    static constexpr std::size_t largest_kept = 2'000'000; // numbers: about 3,000 vertices

    std::mutex mutex_;
    std::vector<std::unique_ptr<Factor>> factors_;
};

LinearSolver::Shelf& LinearSolver::shelf()
{
    static Shelf shelf;
    return shelf;
}

LinearSolver::LinearSolver(const BlockMatrix& matrix, int threads) : factor_(shelf().take(matrix, threads))
{
    if (!factor_) {
        factor_ = std::make_unique<Factor>(matrix, threads);
    }
}

LinearSolver::~LinearSolver()
{
    if (factor_) {
        shelf().keep(std::move(factor_));
    }
}

LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

bool LinearSolver::factor(const BlockMatrix& matrix, double shift)
{
    Factor& f = *factor_;
    std::atomic<bool> failed = false;
    parallel_tasks(f.threads, static_cast<int>(f.subtrees.size()), [&](int k) {
        Task& task = f.subtrees[f.largest_first[k]];
        if (!f.factor_fronts(matrix, shift, task.fronts, task.stack.data(), 1, failed)) {
            failed = true;
        }
    });
    return !failed && f.factor_fronts(matrix, shift, f.top.fronts, f.top.stack.data(), f.threads, failed);
}

// A front's pivots and the rows below it, in strips.
void LinearSolver::Factor::gather(const Eigen::VectorXd& y, int f, std::vector<double>& local) const
{
    local.assign(std::size_t(strip) * shapes[f].strips, 0.0);
    std::copy_n(y.data() + 3 * tree.fronts[f].first, shapes[f].columns, local.data());
    double* below = local.data() + strip * shapes[f].diagonal_strips;
    for (const int place : places[f]) {
        below = std::copy_n(y.data() + 3 * place, 3, below);
    }
}

void LinearSolver::Factor::solve_forward(Eigen::VectorXd& y, const std::vector<int>& fronts) const
{
    std::vector<double> local;
    for (const int f : fronts) {
        const FrontShape& shape = shapes[f];
        gather(y, f, local);
        dense_kernels().solve_forward(&panels[panel_offset[f]], shape.columns, shape.diagonal_strips, shape.strips,
                                      local.data());
        std::copy_n(local.data(), shape.columns, y.data() + 3 * tree.fronts[f].first);
        const double* below = local.data() + strip * shape.diagonal_strips;
        for (const int place : places[f]) {
            std::copy_n(below, 3, y.data() + 3 * place);
            below += 3;
        }
    }
}

void LinearSolver::Factor::solve_backward(Eigen::VectorXd& y, const std::vector<int>& fronts) const
{
    std::vector<double> local;
    std::vector<double> scratch;
    for (std::size_t k = fronts.size(); k-- > 0;) {
        const FrontShape& shape = shapes[fronts[k]];
        gather(y, fronts[k], local);
        scratch.resize(std::size_t(strip) * shape.columns);
        dense_kernels().solve_backward(&panels[panel_offset[fronts[k]]], shape.columns, shape.diagonal_strips,
                                       shape.strips, local.data(), scratch.data());
        std::copy_n(local.data(), shape.columns, y.data() + 3 * tree.fronts[fronts[k]].first);
    }
}

// The subtrees side by side. What each subtracts from the rows above it is gathered at places of its own behind the
// unknowns, and added in the order of the subtrees.
Eigen::VectorXd LinearSolver::solve(const Eigen::VectorXd& right_side) const
{
    const Factor& f = *factor_;
    const std::size_t blocks = f.tree.order.size();
    Eigen::VectorXd y = Eigen::VectorXd::Zero(3 * f.place_count);
    for (std::size_t k = 0; k < blocks; ++k) {
        y.segment<3>(3 * k) = right_side.segment<3>(3 * f.tree.order[k]);
    }
    const auto for_outer_rows = [&](const auto& action) {
        for (const Task& subtree : f.subtrees) {
            int place = subtree.first_outer;
            for (const int row : f.outer_rows(subtree)) {
                action(row, place++);
            }
        }
    };
    const int tasks = static_cast<int>(f.subtrees.size());
    parallel_tasks(f.threads, tasks, [&](int k) { f.solve_forward(y, f.subtrees[k].fronts); });
    for_outer_rows([&](int row, int place) { y.segment<3>(3 * row) += y.segment<3>(3 * place); });
    f.solve_forward(y, f.top.fronts);
    f.solve_backward(y, f.top.fronts);
    for_outer_rows([&](int row, int place) { y.segment<3>(3 * place) = y.segment<3>(3 * row); });
    parallel_tasks(f.threads, tasks, [&](int k) { f.solve_backward(y, f.subtrees[k].fronts); });
    Eigen::VectorXd x(3 * blocks);
    for (std::size_t k = 0; k < blocks; ++k) {
        x.segment<3>(3 * f.tree.order[k]) = y.segment<3>(3 * k);
    }
    return x;
}

const std::vector<int>& LinearSolver::order() const
{
    return factor_->tree.order;
}

double LinearSolver::work() const
{
    return factor_->total_work();
}

} // namespace rhombloom
