#pragma once

#include <vector>

#include "core/form/block_matrix.h"

namespace rhombloom {

//! \brief An order of elimination with little fill: order[k] is the block row eliminated k-th.
//! \details Nested dissection (METIS); approximate minimum degree where that is cheaper, on small matrices.
std::vector<int> fill_reducing_order(const BlockMatrix& matrix);

//! \brief A dense front of the multifrontal method: block columns [first, last) of the factor.
struct Front
{
    int first = 0;
    int last = 0;
    int parent = -1;       //!< number of the front that takes the update; -1: none
    std::vector<int> rows; //!< block rows below the pivots, increasing

    int pivots() const { return last - first; }
};

//! \brief The symbolic factorisation. Fronts are in postorder: children before their parent, subtrees contiguous.
struct EliminationTree
{
    std::vector<int> order;    //!< order[k]: the block row of the matrix that comes k-th
    std::vector<int> position; //!< its inverse
    std::vector<Front> fronts;
};

EliminationTree elimination_tree(const BlockMatrix& matrix);

} // namespace rhombloom
