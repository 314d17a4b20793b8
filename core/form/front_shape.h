#pragma once

#include <cstddef>

#include "core/form/dense_kernels.h"
#include "core/form/elimination_tree.h"

namespace rhombloom {

//! \brief Sizes of a front in scalars. Its panel holds the pivot strips, then the strips below.
struct FrontShape
{
    int columns;
    int rows;
    int diagonal_strips;
    int strips;

    explicit FrontShape(const Front& front)
        : columns(3 * front.pivots()), rows(3 * static_cast<int>(front.rows.size())),
          diagonal_strips(strip_count(columns)), strips(diagonal_strips + strip_count(rows))
    {
    }

    std::size_t panel_size() const { return std::size_t(strip) * columns * strips; }

    std::size_t update_size() const
    {
        const std::size_t below = strips - diagonal_strips;
        return std::size_t(strip) * strip / 2 * below * (below + 1);
    }

    double work() const
    {
        double sum = 0;
        for (int k = 0; k < columns; ++k) {
            const double length = columns - k + rows;
            sum += length * length / 2;
        }
        return sum;
    }
};

//! \brief Offset of scalar row \p i in a panel or a packed update: entry (i, k) lies strip * k farther.
inline std::size_t panel_row(const FrontShape& shape, int i)
{
    return std::size_t(strip) * shape.columns * (i / strip) + i % strip;
}

inline std::size_t update_row(int i)
{
    const std::size_t s = i / strip;
    return std::size_t(strip) * strip / 2 * s * (s + 1) + i % strip;
}

} // namespace rhombloom
