#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

namespace rhombloom {

//! \brief Lower triangle of a symmetric matrix of 3 x 3 blocks, stored by block columns with a fixed pattern.
struct BlockMatrix
{
    int size = 0;              //!< block rows
    std::vector<int> start;    //!< size + 1 offsets into row
    std::vector<int> row;      //!< rows of each column, increasing; the diagonal comes first
    std::vector<double> value; //!< 9 per block, column-major
};

//! \brief The pattern of all diagonal blocks and the given pairs (in any order, repeated or not), values zero.
BlockMatrix make_block_matrix(int size, std::vector<std::pair<int, int>> pairs);

//! \brief Number of the block (max(i, j), min(i, j)).
int block_index(const BlockMatrix& matrix, int i, int j);

//! \brief y = A x.
void multiply(const BlockMatrix& matrix, const Eigen::VectorXd& x, Eigen::VectorXd& y);

} // namespace rhombloom
