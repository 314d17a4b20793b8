// Included once per instruction set by term_kernels.cpp, inside a namespace of its own. Plain loops over arrays of one
// chunk of terms, which the compiler turns into vector code: gather, compute, scatter.

struct SpringChunk
{
    double dx[chunk], dy[chunk], dz[chunk];         // difference of the ends
    double rest0[chunk], rest1[chunk];              //
    double inverse0[chunk], inverse1[chunk];        // 1 / rest length; 0: no spring
    double energy[chunk], guard[chunk], pull[chunk]; // pull: force / length
};

void gather_springs(const SpringPair* springs, int count, const double* x, SpringChunk& c)
{
    for (int i = 0; i < count; ++i) {
        const double* a = x + 3 * springs[i].a;
        const double* b = x + 3 * springs[i].b;
        c.dx[i] = b[0] - a[0];
        c.dy[i] = b[1] - a[1];
        c.dz[i] = b[2] - a[2];
        c.rest0[i] = springs[i].rest[0];
        c.rest1[i] = springs[i].rest[1];
        c.inverse0[i] = springs[i].inverse_rest[0];
        c.inverse1[i] = springs[i].inverse_rest[1];
    }
    for (int i = count; i < (count + 7) / 8 * 8; ++i) { // no spring: no energy
        c.dx[i] = c.dy[i] = c.dz[i] = c.rest0[i] = c.rest1[i] = 1;
        c.inverse0[i] = c.inverse1[i] = 0;
    }
}

void compute_springs(const SpringLaw& law, int padded, SpringChunk& c)
{
    const double stretched = law.stretched_weight;
    const double compressed = law.compressed_weight;
    const double barrier = law.barrier_weight;
    const double ratio = law.barrier_ratio;
    for (int i = 0; i < padded; ++i) {
        const double length = __builtin_sqrt(c.dx[i] * c.dx[i] + c.dy[i] * c.dy[i] + c.dz[i] * c.dz[i]);
        const double change0 = length - c.rest0[i];
        const double change1 = length - c.rest1[i];
        const double force0 = (change0 > 0 ? stretched : compressed) * c.inverse0[i] * change0;
        const double force1 = (change1 > 0 ? stretched : compressed) * c.inverse1[i] * change1;
        const double excess0 = length - ratio * c.rest0[i];
        const double excess1 = length - ratio * c.rest1[i];
        const double barrier0 = barrier * c.inverse0[i] * (excess0 < 0 ? excess0 : 0);
        const double barrier1 = barrier * c.inverse1[i] * (excess1 < 0 ? excess1 : 0);
        c.energy[i] = force0 * change0 + force1 * change1;
        c.guard[i] = barrier0 * excess0 + barrier1 * excess1;
        const double force = 2 * ((force0 + force1) + (barrier0 + barrier1));
        c.pull[i] = force / (length > smallest_length ? length : smallest_length);
    }
}

void scatter_springs(const SpringPair* springs, int count, const SpringChunk& c, double* gradient)
{
    for (int i = 0; i < count; ++i) {
        double* a = gradient + 3 * springs[i].a;
        double* b = gradient + 3 * springs[i].b;
        const double pull[3] = {c.pull[i] * c.dx[i], c.pull[i] * c.dy[i], c.pull[i] * c.dz[i]};
        for (int k = 0; k < 3; ++k) {
            a[k] -= pull[k];
            b[k] += pull[k];
        }
    }
}

void add_in_eight(const double* values, int padded, double (&sums)[8])
{
    for (int i = 0; i < padded; i += 8) {
        for (int k = 0; k < 8; ++k) {
            sums[k] += values[i + k];
        }
    }
}

double total(const double (&s)[8])
{
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

TermEnergy springs(const EmbeddingTerms& terms, const double* x, double* gradient)
{
    SpringChunk c;
    double energy[8] = {};
    double guard[8] = {};
    const int total_count = static_cast<int>(terms.springs.size());
    for (int first = 0; first < total_count; first += chunk) {
        const int count = total_count - first < chunk ? total_count - first : chunk;
        const int padded = (count + 7) / 8 * 8;
        gather_springs(&terms.springs[first], count, x, c);
        compute_springs(terms.spring_law, padded, c);
        add_in_eight(c.energy, padded, energy);
        add_in_eight(c.guard, padded, guard);
        if (gradient != nullptr) {
            scatter_springs(&terms.springs[first], count, c, gradient);
        }
    }
    return {total(energy), total(guard)};
}

struct Triple
{
    double x[chunk], y[chunk], z[chunk];
};

struct HingeChunk
{
    Triple e, r2, r3; // edge, apexes from x0
    Triple n1, n2;    // normals, then the gradient by the apexes
    double side[chunk], across[chunk];
    double foot1[chunk], foot2[chunk]; // of the apexes, along the edge
    double energy[chunk], guard[chunk];
    const HingeVertices* hinge[chunk];
};

void gather_triple(const double* from, const double* to, Triple& t, int i)
{
    t.x[i] = to[0] - from[0];
    t.y[i] = to[1] - from[1];
    t.z[i] = to[2] - from[2];
}

void gather_hinge(const HingeVertices& hinge, const double* x, HingeChunk& c, int i)
{
    const double* x0 = x + 3 * hinge[0];
    gather_triple(x0, x + 3 * hinge[1], c.e, i);
    gather_triple(x0, x + 3 * hinge[2], c.r2, i);
    gather_triple(x0, x + 3 * hinge[3], c.r3, i);
    c.hinge[i] = &hinge;
}

void compute_normals(int count, HingeChunk& c)
{
    for (int i = 0; i < count; ++i) {
        const double nx = c.e.y[i] * c.r2.z[i] - c.e.z[i] * c.r2.y[i];
        const double ny = c.e.z[i] * c.r2.x[i] - c.e.x[i] * c.r2.z[i];
        const double nz = c.e.x[i] * c.r2.y[i] - c.e.y[i] * c.r2.x[i];
        const double mx = c.r3.y[i] * c.e.z[i] - c.r3.z[i] * c.e.y[i];
        const double my = c.r3.z[i] * c.e.x[i] - c.r3.x[i] * c.e.z[i];
        const double mz = c.r3.x[i] * c.e.y[i] - c.r3.y[i] * c.e.x[i];
        c.side[i] = -(nx * c.r3.x[i] + ny * c.r3.y[i] + nz * c.r3.z[i]);
        c.across[i] = nx * mx + ny * my + nz * mz;
        c.n1.x[i] = nx;
        c.n1.y[i] = ny;
        c.n1.z[i] = nz;
        c.n2.x[i] = mx;
        c.n2.y[i] = my;
        c.n2.z[i] = mz;
    }
}

void move_hinge(HingeChunk& c, int from, int to)
{
    for (Triple HingeChunk::*t : {&HingeChunk::e, &HingeChunk::r2, &HingeChunk::r3, &HingeChunk::n1, &HingeChunk::n2}) {
        (c.*t).x[to] = (c.*t).x[from];
        (c.*t).y[to] = (c.*t).y[from];
        (c.*t).z[to] = (c.*t).z[from];
    }
    c.side[to] = c.side[from];
    c.across[to] = c.across[from];
    c.hinge[to] = c.hinge[from];
}

// Keep the hinges that may cost something: concave ones, and ones folded so far that the ridge may act.
int keep_active(const HingeLaw& law, int count, HingeChunk& c)
{
    if (law.convex_weight != 0) {
        return count;
    }
    int kept = 0;
    for (int i = 0; i < count; ++i) {
        if (!(c.side[i] >= 0 && c.across[i] >= 0)) {
            move_hinge(c, i, kept++);
        }
    }
    return kept;
}

// After this n1, n2 hold the gradient by the apexes; energy, guard are set.
void compute_hinges(const HingeLaw& law, int count, HingeChunk& c)
{
    const double concave = law.concavity_weight;
    const double convex = law.convex_weight * law.concavity_weight;
    const double ridge = ridge_weight(law);
    const double start = law.ridge_start;
    for (int i = 0; i < count; ++i) {
        const double square = c.e.x[i] * c.e.x[i] + c.e.y[i] * c.e.y[i] + c.e.z[i] * c.e.z[i];
        const double length = __builtin_sqrt(square);
        const double angle = angle_of(c.side[i] * length, c.across[i]);
        const double weight = angle < 0 ? concave : convex;
        const double excess = angle - start > 0 ? angle - start : 0;
        const double moment = 2 * (weight * angle + ridge * excess);
        c.energy[i] = weight * angle * angle;
        c.guard[i] = ridge * excess * excess;
        const double safe = square > smallest_square ? square : smallest_square;
        c.foot1[i] = (c.r2.x[i] * c.e.x[i] + c.r2.y[i] * c.e.y[i] + c.r2.z[i] * c.e.z[i]) / safe;
        c.foot2[i] = (c.r3.x[i] * c.e.x[i] + c.r3.y[i] * c.e.y[i] + c.r3.z[i] * c.e.z[i]) / safe;
        const double square1 = c.n1.x[i] * c.n1.x[i] + c.n1.y[i] * c.n1.y[i] + c.n1.z[i] * c.n1.z[i];
        const double square2 = c.n2.x[i] * c.n2.x[i] + c.n2.y[i] * c.n2.y[i] + c.n2.z[i] * c.n2.z[i];
        const double factor1 = -moment * length / (square1 > smallest_square ? square1 : smallest_square);
        const double factor2 = -moment * length / (square2 > smallest_square ? square2 : smallest_square);
        c.n1.x[i] *= factor1;
        c.n1.y[i] *= factor1;
        c.n1.z[i] *= factor1;
        c.n2.x[i] *= factor2;
        c.n2.y[i] *= factor2;
        c.n2.z[i] *= factor2;
    }
}

void scatter_hinges(int count, const HingeChunk& c, double* gradient)
{
    for (int i = 0; i < count; ++i) {
        const HingeVertices& hinge = *c.hinge[i];
        const double left[3] = {c.n1.x[i], c.n1.y[i], c.n1.z[i]};
        const double right[3] = {c.n2.x[i], c.n2.y[i], c.n2.z[i]};
        for (int k = 0; k < 3; ++k) {
            gradient[3 * hinge[0] + k] -= (1 - c.foot1[i]) * left[k] + (1 - c.foot2[i]) * right[k];
            gradient[3 * hinge[1] + k] -= c.foot1[i] * left[k] + c.foot2[i] * right[k];
            gradient[3 * hinge[2] + k] += left[k];
            gradient[3 * hinge[3] + k] += right[k];
        }
    }
}

TermEnergy hinges(const EmbeddingTerms& terms, const double* x, double* gradient)
{
    HingeChunk c;
    double energy[8] = {};
    double guard[8] = {};
    const int total_count = static_cast<int>(terms.hinges.size());
    int taken = 0;
    const auto finish = [&] {
        compute_hinges(terms.hinge_law, taken, c);
        const int padded = (taken + 7) / 8 * 8;
        for (int i = taken; i < padded; ++i) {
            c.energy[i] = c.guard[i] = 0;
        }
        add_in_eight(c.energy, padded, energy);
        add_in_eight(c.guard, padded, guard);
        if (gradient != nullptr) {
            scatter_hinges(taken, c, gradient);
        }
    };
    for (int first = 0; first < total_count; first += chunk) {
        const int count = total_count - first < chunk ? total_count - first : chunk;
        for (int i = 0; i < count; ++i) {
            gather_hinge(terms.hinges[first + i], x, c, i);
        }
        compute_normals(count, c);
        taken = keep_active(terms.hinge_law, count, c);
        finish();
    }
    return {total(energy), total(guard)};
}

constexpr TermKernels table = {springs, hinges};
