#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "core/form/elimination_tree.h"
#include "core/form/front_shape.h"
#include "core/form/linear_solver.h"

namespace rhombloom {

//! \brief Where a block of the matrix goes: the same place of its front's panel in every factorisation.
struct BlockTarget
{
    std::size_t block;
    std::array<std::size_t, 3> row; // offsets of its scalar rows at its first column
    bool transposed;
    bool diagonal;
};

//! \brief Fronts factored in one go, children first, with the stack of its pending updates.
struct Task
{
    std::vector<int> fronts;
    std::vector<double> stack;
    int first_outer = 0; // place in the vector being solved for of the first of its rows outside
};

//! \brief What LinearSolver keeps of a pattern, and the factor itself.
struct LinearSolver::Factor
{
    std::vector<int> pattern_start; // of the matrix
    std::vector<int> pattern_row;
    EliminationTree tree;
    std::vector<FrontShape> shapes;
    std::vector<std::size_t> panel_offset;
    std::vector<BlockTarget> targets;
    std::vector<std::size_t> first_target; // per front
    std::vector<std::vector<int>> children;
    std::vector<std::vector<int>> places; // per front: of its rows below the pivots, in the vector being solved for
    int place_count = 0;                  // block rows of that vector
    std::vector<Task> subtrees;           // independent of each other
    std::vector<int> largest_first;       // these, by work
    Task top;                             // the fronts that are in no subtree, in order
    std::vector<double> panels;
    std::vector<double*> update; // per front, while its parent needs it
    int threads = 1;

    explicit Factor(const BlockMatrix& matrix, int thread_count);
    void find_targets(const BlockMatrix& matrix);
    void split_into_tasks();
    void find_places();
    std::size_t stack_size(const std::vector<int>& fronts) const;

    bool factor_fronts(const BlockMatrix& matrix, double shift, const std::vector<int>& fronts, double* stack,
                       int helpers, const std::atomic<bool>& failed);
    void assemble_matrix(const BlockMatrix& matrix, double shift, int f);
    void assemble_child(int f, int child, double* update_matrix, int helpers);
    bool factor_panel(int f, int helpers);
    void subtract_update(int f, double* update_matrix, int helpers) const;
    double total_work() const;

    const std::vector<int>& outer_rows(const Task& subtree) const { return tree.fronts[subtree.fronts.back()].rows; }
    void gather(const Eigen::VectorXd& y, int f, std::vector<double>& local) const;
    void solve_forward(Eigen::VectorXd& y, const std::vector<int>& fronts) const;
    void solve_backward(Eigen::VectorXd& y, const std::vector<int>& fronts) const;
};

} // namespace rhombloom
