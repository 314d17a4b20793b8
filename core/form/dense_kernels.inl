// Included once per instruction set by dense_kernels.cpp, inside a namespace of its own that defines `lanes` (doubles per
// vector register) and `paired` (strips treated at once).

using Vector = double __attribute__((vector_size(lanes * sizeof(double)), aligned(8), may_alias));

constexpr int parts = strip / lanes; // registers per strip

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

    // entry(:, j) -= sum over k of a(:, k) * b_j(k), in order of k.
    void subtract_products(const double* const (&a)[S], const double* const (&b)[N], int count)
    {
        for (int k = 0; k < count; ++k) {
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

    template <int S, class Finish>
    void treat(int s, const Finish& finish) const
    {
        const double* a[S];
        double* c[S];
        const double* c_const[S];
        for (int i = 0; i < S; ++i) {
            a[i] = panel + strip * columns * (s + i);
            c[i] = panel + strip * columns * (s + i) + strip * first;
            c_const[i] = c[i];
        }
        Tile<S, N> tile;
        tile.load(c_const);
        finish(tile, a);
        tile.store(c);
    }
};

// The strips [first, last) of a block column, whose triangle is done.
template <int N>
void finish_block_column(const BlockColumn<N>& block, const double (&triangle)[N][N], const double (&inverse)[N],
                         int first, int last)
{
    int s = first;
    for (; s + paired <= last; s += paired) {
        block.template treat<paired>(s, [&](Tile<paired, N>& tile, const double* const(&a)[paired]) {
            tile.subtract_products(a, block.row, block.first);
            tile.divide(triangle, inverse);
        });
    }
    for (; s < last; ++s) {
        block.template treat<1>(s, [&](Tile<1, N>& tile, const double* const(&a)[1]) {
            tile.subtract_products(a, block.row, block.first);
            tile.divide(triangle, inverse);
        });
    }
}

template <int N>
bool factor_block_column(double* panel, int columns, int first, int strips, double* inverses)
{
    const BlockColumn<N> block(panel, columns, first);
    const int top = first / strip;
    const int below = (first + N - 1) / strip + 1;
    for (int s = top; s < below; ++s) {
        block.template treat<1>(
            s, [&](Tile<1, N>& tile, const double* const(&a)[1]) { tile.subtract_products(a, block.row, first); });
    }
    double triangle[N][N];
    double inverse[N];
    if (!factor_triangle<N>(panel, columns, first, triangle, inverse)) {
        return false;
    }
    for (int s = top; s < below; ++s) {
        block.template treat<1>(s, [&](Tile<1, N>& tile, const double* const(&)[1]) { tile.divide(triangle, inverse); });
    }
    finish_block_column<N>(block, triangle, inverse, below, strips);
    for (int j = 0; inverses != nullptr && j < N; ++j) {
        inverses[first + j] = inverse[j];
    }
    return true;
}

bool factor(double* panel, int columns, int strips, double* inverse)
{
    int first = 0;
    for (; first + 4 <= columns; first += 4) {
        if (!factor_block_column<4>(panel, columns, first, strips, inverse)) {
            return false;
        }
    }
    switch (columns - first) {
    case 1:
        return factor_block_column<1>(panel, columns, first, strips, inverse);
    case 2:
        return factor_block_column<2>(panel, columns, first, strips, inverse);
    case 3:
        return factor_block_column<3>(panel, columns, first, strips, inverse);
    default:
        return true;
    }
}

template <int N>
void factor_rows_of(double* panel, int columns, int column, const double* inverses, int first, int last)
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
    finish_block_column<N>(block, triangle, inverse, first, last);
}

void factor_rows(double* panel, int columns, const double* inverse, int first, int last)
{
    int column = 0;
    for (; column + 4 <= columns; column += 4) {
        factor_rows_of<4>(panel, columns, column, inverse, first, last);
    }
    switch (columns - column) {
    case 1:
        return factor_rows_of<1>(panel, columns, column, inverse, first, last);
    case 2:
        return factor_rows_of<2>(panel, columns, column, inverse, first, last);
    case 3:
        return factor_rows_of<3>(panel, columns, column, inverse, first, last);
    default:
        return;
    }
}

double* update_strip(double* update, int s)
{
    return update + 4 * static_cast<long>(strip) * s * (s + 1);
}

template <int S>
void update_strips(const double* below, int columns, double* update, int s, int first, int last)
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
        tile.subtract_products(a, b, columns);
        tile.store(c);
    }
}

void update(const double* below, int columns, double* target, int first, int last)
{
    int s = first;
    for (; s + paired <= last; s += paired) {
        update_strips<paired>(below, columns, target, s, 0, strip * (s + 1));
        for (int i = 1; i < paired; ++i) {
            update_strips<1>(below, columns, target, s + i, strip * (s + 1), strip * (s + i + 1));
        }
    }
    for (; s < last; ++s) {
        update_strips<1>(below, columns, target, s, 0, strip * (s + 1));
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

// sums(k) += column k of the strip times w(strip), lane by lane.
void add_columns(const double* row, int count, const double* w, double* sums)
{
    for (int k = 0; k < count; ++k) {
        for (int p = 0; p < parts; ++p) {
            const int offset = strip * k + lanes * p;
            *reinterpret_cast<Vector*>(sums + offset) += *reinterpret_cast<const Vector*>(row + offset) *
                                                         *reinterpret_cast<const Vector*>(w + lanes * p);
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
    for (int s = strips - 1; s >= diagonal_strips; --s) {
        add_columns(panel + static_cast<long>(strip) * columns * s, columns, w + strip * s, scratch);
    }
    for (int s = diagonal_strips - 1; s >= 0; --s) {
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
        add_columns(row, strip * s, w + strip * s, scratch);
    }
}

constexpr DenseKernels table = {factor, factor_rows, update, solve_forward, solve_backward};
