// Included once per instruction set by dense_kernels.cpp, inside a namespace of its own that defines `lanes` (doubles
// per vector register) and `paired` (strips treated at once).

using Vector = double __attribute__((vector_size(lanes * sizeof(double)), aligned(8), may_alias));

constexpr int parts = strip / lanes; // registers per strip
constexpr int depth = 128; // columns of a panel whose products are subtracted at once: a tile's rows stay in the
                           // first cache
constexpr int width = 64;  // columns they are subtracted from: a multiple of a strip, in the second cache

// Tile of `S` strips times `N` columns held in registers.
template <int S, int N>
struct Tile
{
    Vector entry[S][parts][N];

    void load(const double* const (&c)[S])
    {
        for (int s = 0; s < S; ++s) {
            for (int p = 0; p < parts; ++p) {
                for (int j = 0; j < N; ++j) {
                    entry[s][p][j] = *reinterpret_cast<const Vector*>(c[s] + strip * j + lanes * p);
                }
            }
        }
    }

    void store(double* const (&c)[S]) const
    {
        for (int s = 0; s < S; ++s) {
            for (int p = 0; p < parts; ++p) {
                for (int j = 0; j < N; ++j) {
                    *reinterpret_cast<Vector*>(c[s] + strip * j + lanes * p) = entry[s][p][j];
                }
            }
        }
    }

    // entry(:, j) -= sum over k in [begin, end) of a(:, k) * b_j(k), in order of k.
    void subtract_products(const double* const (&a)[S], const double* const (&b)[N], int begin, int end)
    {
        for (int k = begin; k < end; ++k) {
            Vector column[S][parts];
            for (int s = 0; s < S; ++s) {
                for (int p = 0; p < parts; ++p) {
                    column[s][p] = *reinterpret_cast<const Vector*>(a[s] + strip * k + lanes * p);
                }
            }
            for (int j = 0; j < N; ++j) {
                const double factor = b[j][strip * k];
                for (int s = 0; s < S; ++s) {
                    for (int p = 0; p < parts; ++p) {
                        entry[s][p][j] -= column[s][p] * factor;
                    }
                }
            }
        }
    }

    // entry := entry * L^-T for the N x N triangle with the given inverse diagonal.
    void divide(const double (&triangle)[N][N], const double (&inverse)[N])
    {
        for (int j = 0; j < N; ++j) {
            for (int s = 0; s < S; ++s) {
                for (int p = 0; p < parts; ++p) {
                    for (int q = 0; q < j; ++q) {
                        entry[s][p][j] -= entry[s][p][q] * triangle[j][q];
                    }
                    entry[s][p][j] *= inverse[j];
                }
            }
        }
    }
};

double* at(double* panel, int columns, int row, int column)
{
    return panel + strip * columns * (row / strip) + strip * column + row % strip;
}

// Cholesky factor of the N x N block on the diagonal at column `first`.
template <int N>
bool factor_triangle(double* panel, int columns, int first, double (&triangle)[N][N], double (&inverse)[N])
{
    for (int j = 0; j < N; ++j) {
        for (int i = j; i < N; ++i) {
            double value = *at(panel, columns, first + i, first + j);
            for (int q = 0; q < j; ++q) {
                value -= triangle[i][q] * triangle[j][q];
            }
            if (i == j) {
                if (!(value > 0)) {
                    return false;
                }
                inverse[j] = 1 / __builtin_sqrt(value);
            }
            triangle[i][j] = value * inverse[j];
        }
    }
    return true;
}

// Columns [first, first + N) of a panel: each entry is what it was less the products of its row and its column's pivot
// row.
template <int N>
struct BlockColumn
{
    double* panel;
    int columns;
    int first;
    const double* row[N];

    BlockColumn(double* panel_, int columns_, int first_) : panel(panel_), columns(columns_), first(first_)
    {
        for (int j = 0; j < N; ++j) {
            row[j] = at(panel, columns, first + j, 0);
        }
    }

    // Products with the columns [begin, end), then what else is to be done with each tile of the strips from s on.
    template <int S, class Finish>
    void treat(int s, int begin, int end, const Finish& finish) const
    {
        const double* a[S];
        double* c[S];
        const double* c_const[S];
        for (int i = 0; i < S; ++i) {
            a[i] = panel + static_cast<long>(strip) * columns * (s + i);
            c[i] = panel + static_cast<long>(strip) * columns * (s + i) + strip * first;
            c_const[i] = c[i];
        }
        Tile<S, N> tile;
        tile.load(c_const);
        tile.subtract_products(a, row, begin, end);
        finish(tile);
        tile.store(c);
    }
};

// Apply action<S>(s), which treats S strips from s on, to the strips [first, last).
template <class Action>
void for_strips(int first, int last, const Action& action)
{
    int s = first;
    for (; s + paired <= last; s += paired) {
        action.template operator()<paired>(s);
    }
    for (; s < last; ++s) {
        action.template operator()<1>(s);
    }
}

// Apply action<N>(column) to the columns [first, last), up to four at once.
template <class Action>
auto for_columns(int first, int last, const Action& action)
{
    for (; first + 4 <= last; first += 4) {
        if (!action.template operator()<4>(first)) {
            return false;
        }
    }
    switch (last - first) {
    case 1:
        return action.template operator()<1>(first);
    case 2:
        return action.template operator()<2>(first);
    case 3:
        return action.template operator()<3>(first);
    default:
        return true;
    }
}

// The strips [first, last) of a block column, whose triangle is done; products with the columns from `begin` on.
template <int N>
void finish_block_column(const BlockColumn<N>& block, const double (&triangle)[N][N], const double (&inverse)[N],
                         int begin, int first, int last)
{
    for_strips(first, last, [&]<int S>(int s) {
        block.template treat<S>(s, begin, block.first, [&](Tile<S, N>& tile) { tile.divide(triangle, inverse); });
    });
}

template <int N>
bool factor_block_column(double* panel, int columns, int first, int begin, int strips, double* inverses)
{
    const BlockColumn<N> block(panel, columns, first);
    const int top = first / strip;
    const int below = (first + N - 1) / strip + 1;
    for (int s = top; s < below; ++s) {
        block.template treat<1>(s, begin, first, [](Tile<1, N>&) {});
    }
    double triangle[N][N];
    double inverse[N];
    if (!factor_triangle<N>(panel, columns, first, triangle, inverse)) {
        return false;
    }
    for (int s = top; s < below; ++s) {
        block.template treat<1>(s, 0, 0, [&](Tile<1, N>& tile) { tile.divide(triangle, inverse); });
    }
    finish_block_column<N>(block, triangle, inverse, begin, below, strips);
    for (int j = 0; inverses != nullptr && j < N; ++j) {
        inverses[first + j] = inverse[j];
    }
    return true;
}

// Subtract from the columns [first, last) of the strips [top, bottom) the products with all columns before them, as
// many at once as stay in the caches.
void subtract_before(double* panel, int columns, int first, int last, int top, int bottom)
{
    for (int begin = 0; begin < first; begin += depth) {
        const int end = begin + depth < first ? begin + depth : first;
        for_strips(top, bottom, [&]<int S>(int s) {
            for_columns(first, last, [&]<int N>(int column) {
                BlockColumn<N>(panel, columns, column).template treat<S>(s, begin, end, [](Tile<S, N>&) {});
                return true;
            });
        });
    }
}

bool factor(double* panel, int columns, int first, int last, int strips, double* inverse)
{
    for (int left = first; left < last; left += width) {
        const int right = left + width < last ? left + width : last;
        subtract_before(panel, columns, left, right, left / strip, strips);
        const bool positive = for_columns(left, right, [&]<int N>(int column) {
            return factor_block_column<N>(panel, columns, column, left, strips, inverse);
        });
        if (!positive) {
            return false;
        }
    }
    return true;
}

template <int N>
void factor_rows_of(double* panel, int columns, int column, int begin, const double* inverses, int first, int last)
{
    const BlockColumn<N> block(panel, columns, column);
    double triangle[N][N];
    double inverse[N];
    for (int i = 0; i < N; ++i) {
        for (int j = 0; j <= i; ++j) {
            triangle[i][j] = *at(panel, columns, column + i, column + j);
        }
        inverse[i] = inverses[column + i];
    }
    finish_block_column<N>(block, triangle, inverse, begin, first, last);
}

void factor_rows(double* panel, int columns, int first, int last, const double* inverse, int top, int bottom)
{
    for (int left = first; left < last; left += width) {
        const int right = left + width < last ? left + width : last;
        subtract_before(panel, columns, left, right, top, bottom);
        for_columns(left, right, [&]<int N>(int column) {
            factor_rows_of<N>(panel, columns, column, left, inverse, top, bottom);
            return true;
        });
    }
}

double* update_strip(double* update, int s)
{
    return update + 4 * static_cast<long>(strip) * s * (s + 1);
}

// The columns [first, last) of S strips less the products with the columns [begin, end) of the panel.
template <int S>
void update_strips(const double* below, int columns, double* update, int s, int first, int last, int begin, int end)
{
    constexpr int N = 4;
    const double* a[S];
    for (int i = 0; i < S; ++i) {
        a[i] = below + static_cast<long>(strip) * columns * (s + i);
    }
    for (int j = first; j < last; j += N) {
        const double* b[N];
        const double* row = below + static_cast<long>(strip) * columns * (j / strip) + j % strip;
        double* c[S];
        const double* c_const[S];
        for (int q = 0; q < N; ++q) {
            b[q] = row + q;
        }
        for (int i = 0; i < S; ++i) {
            c[i] = update_strip(update, s + i) + strip * j;
            c_const[i] = c[i];
        }
        Tile<S, N> tile;
        tile.load(c_const);
        tile.subtract_products(a, b, begin, end);
        tile.store(c);
    }
}

void update(const double* below, int columns, double* target, int first, int last)
{
    for (int begin = 0; begin < columns; begin += depth) {
        const int end = begin + depth < columns ? begin + depth : columns;
        for (int left = 0; left < strip * last; left += width) {
            const int top = first > left / strip ? first : left / strip;
            for_strips(top, last, [&]<int S>(int s) {
                const int right = left + width < strip * (s + 1) ? left + width : strip * (s + 1);
                update_strips<S>(below, columns, target, s, left, right, begin, end);
                for (int i = 1; i < S && right < left + width; ++i) {
                    update_strips<1>(below, columns, target, s + i, strip * (s + 1), strip * (s + i + 1), begin, end);
                }
            });
        }
    }
}

// w(strip) -= strip of L times the pivots, columns [0, count).
void subtract_row(const double* row, int count, const double* pivots, double* w)
{
    Vector sum[parts];
    for (int p = 0; p < parts; ++p) {
        sum[p] = *reinterpret_cast<const Vector*>(w + lanes * p);
    }
    for (int k = 0; k < count; ++k) {
        for (int p = 0; p < parts; ++p) {
            sum[p] -= *reinterpret_cast<const Vector*>(row + strip * k + lanes * p) * pivots[k];
        }
    }
    for (int p = 0; p < parts; ++p) {
        *reinterpret_cast<Vector*>(w + lanes * p) = sum[p];
    }
}

void solve_forward(const double* panel, int columns, int diagonal_strips, int strips, double* w)
{
    for (int s = 0; s < strips; ++s) {
        const double* row = panel + static_cast<long>(strip) * columns * s;
        const bool below = s >= diagonal_strips;
        subtract_row(row, below ? columns : strip * s, w, w + strip * s);
        for (int k = strip * s; !below && k < columns && k < strip * (s + 1); ++k) {
            const double* column = row + strip * k;
            w[k] /= column[k % strip];
            for (int i = k + 1; i < strip * (s + 1); ++i) {
                w[i] -= column[i % strip] * w[k];
            }
        }
    }
}

// sums(k) += column k of the strips from the first on upwards times w, lane by lane; `row` and `w` are those of the
// first.
template <int S>
void add_columns(const double* row, int columns, int count, const double* w, double* sums)
{
    for (int k = 0; k < count; ++k) {
        for (int p = 0; p < parts; ++p) {
            const int offset = strip * k + lanes * p;
            Vector sum = *reinterpret_cast<const Vector*>(sums + offset);
            for (int i = 0; i < S; ++i) {
                sum += *reinterpret_cast<const Vector*>(row - static_cast<long>(strip) * columns * i + offset) *
                       *reinterpret_cast<const Vector*>(w - strip * i + lanes * p);
            }
            *reinterpret_cast<Vector*>(sums + offset) = sum;
        }
    }
}

double lane_sum(const double* s)
{
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

void solve_backward(const double* panel, int columns, int diagonal_strips, int strips, double* w, double* scratch)
{
    __builtin_memset(scratch, 0, sizeof(double) * strip * columns);
    int s = strips - 1;
    for (; s - 3 >= diagonal_strips; s -= 4) {
        add_columns<4>(panel + static_cast<long>(strip) * columns * s, columns, columns, w + strip * s, scratch);
    }
    for (; s >= diagonal_strips; --s) {
        add_columns<1>(panel + static_cast<long>(strip) * columns * s, columns, columns, w + strip * s, scratch);
    }
    for (; s >= 0; --s) {
        const double* row = panel + static_cast<long>(strip) * columns * s;
        const int end = columns < strip * (s + 1) ? columns : strip * (s + 1);
        for (int k = end - 1; k >= strip * s; --k) {
            double value = w[k] - lane_sum(scratch + strip * k);
            for (int i = k + 1; i < end; ++i) {
                value -= row[strip * k + i % strip] * w[i];
            }
            w[k] = value / row[strip * k + k % strip];
        }
        for (int k = end; k < strip * (s + 1); ++k) {
            w[k] = 0;
        }
        add_columns<1>(row, columns, strip * s, w + strip * s, scratch);
    }
}

constexpr DenseKernels table = {factor, factor_rows, update, solve_forward, solve_backward};
