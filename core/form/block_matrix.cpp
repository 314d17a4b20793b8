#include "core/form/block_matrix.h"

#include <algorithm>

#include "core/expected.h"

namespace rhombloom {

BlockMatrix make_block_matrix(int size, std::vector<std::pair<int, int>> pairs)
{
    for (auto& [i, j] : pairs) {
        if (i < j) {
            std::swap(i, j);
        }
        std::swap(i, j); // (column, row)
    }
    for (int i = 0; i < size; ++i) {
        pairs.emplace_back(i, i);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    BlockMatrix matrix;
    matrix.size = size;
    matrix.start.assign(size + 1, 0);
    for (const auto& [column, row] : pairs) {
        ++matrix.start[column + 1];
        matrix.row.push_back(row);
    }
    for (int j = 0; j < size; ++j) {
        matrix.start[j + 1] += matrix.start[j];
    }
    matrix.value.assign(9 * matrix.row.size(), 0.0);
    return matrix;
}

int block_index(const BlockMatrix& matrix, int i, int j)
{
    const int column = std::min(i, j);
    const int row = std::max(i, j);
    const auto first = matrix.row.begin() + matrix.start[column];
    const auto last = matrix.row.begin() + matrix.start[column + 1];
    const auto found = std::lower_bound(first, last, row);
    expects(found != last && *found == row, "block_index: the block is in the pattern");
    return static_cast<int>(found - matrix.row.begin());
}

void multiply(const BlockMatrix& matrix, const Eigen::VectorXd& x, Eigen::VectorXd& y)
{
    y.setZero(3 * matrix.size);
    for (int j = 0; j < matrix.size; ++j) {
        for (int k = matrix.start[j]; k < matrix.start[j + 1]; ++k) {
            const Eigen::Map<const Eigen::Matrix3d> block(&matrix.value[9 * k]);
            const int i = matrix.row[k];
            y.segment<3>(3 * i) += block * x.segment<3>(3 * j);
            if (i != j) {
                y.segment<3>(3 * j) += block.transpose() * x.segment<3>(3 * i);
            }
        }
    }
}

} // namespace rhombloom
