#pragma once

namespace rhombloom {

//! \brief Rows of a dense front are stored in strips of eight: entry (i, k) of a matrix with K columns lies at
//! `8 * K * (i / 8) + 8 * k + i % 8`. The last strip is padded with rows of zeros.
inline constexpr int strip = 8;

//! \brief Number of strips that \p rows rows take.
constexpr int strip_count(int rows)
{
    return (rows + strip - 1) / strip;
}

//! \brief The inner loops of the multifrontal factorisation, for one instruction set.
//! \details Every entry is the same sequence of multiplications and subtractions whatever the vector length (and there
//! are no fused operations), so all machines return the same bytes.
struct DenseKernels
{
    //! \brief Columns [first, last) of a front's Cholesky factor, those before them being done, in its first \p strips
    //! strips: at least those with the pivot rows of these columns; only the lower triangle counts. \p first is a
    //! multiple of eight. False when a pivot is not positive. \p inverse, unless null, receives the inverses of the
    //! factor's diagonal.
    bool (*factor)(double* panel, int columns, int first, int last, int strips, double* inverse);

    //! \brief The rest of these columns, with the same bytes as in one go: the strips [top, bottom) below their pivots.
    void (*factor_rows)(double* panel, int columns, int first, int last, const double* inverse, int top, int bottom);

    //! \brief update -= below * below^T for the strips [first, last) of the update's packed lower triangle, whose strip
    //! s has 8 * (s + 1) columns and begins at 32 * s * (s + 1).
    void (*update)(const double* below, int columns, double* update, int first, int last);

    //! \brief w := L^-1 w for the pivot rows of \p w, then w -= L w for the rows below,
    //! which must hold what is to be subtracted from.
    void (*solve_forward)(const double* panel, int columns, int diagonal_strips, int strips, double* w);

    //! \brief The transposed step: the pivot rows of \p w from the rows below. \p scratch: 8 * columns numbers.
    void (*solve_backward)(const double* panel, int columns, int diagonal_strips, int strips, double* w,
                           double* scratch);
};

//! \brief The fastest kernels that this machine can run.
const DenseKernels& dense_kernels();

} // namespace rhombloom
