#include "core/form/term_kernels.h"

#include "core/form/instruction_set.h"

#include <initializer_list>

namespace rhombloom {

namespace {

constexpr int chunk = 128;                // terms treated together: their arrays stay in the nearest cache
constexpr double smallest_length = 1e-12; // in la; below, the direction of a spring is noise
constexpr double smallest_square = 1e-24; // in la^4; keeps collapsed triangles finite

// atan(t) for 0 <= t <= 1, rational approximation of the Cephes library on [0, 0.66], moved by pi/4 above.
[[gnu::always_inline]] inline double unit_atan(double t)
{
    const bool high = t > 0.66;
    const double r = high ? (t - 1) / (t + 1) : t;
    const double z = r * r;
    const double p =
        (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
         1.228866684490136173410e2) *
            z -
        6.485021904942025371773e1;
    const double q =
        ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) * z +
         4.853903996359136964868e2) *
            z +
        1.945506571482613964425e2;
    const double correction = high ? 3.061616997868382943065e-17 : 0.0; // pi/4 minus its double
    return (high ? 0.78539816339744830962 : 0.0) + (r * (z * p / q) + r + correction);
}

// Written without branches, for vector code.
[[gnu::always_inline]] inline double angle_of(double y, double x)
{
    const double ax = x < 0 ? -x : x;
    const double ay = y < 0 ? -y : y;
    const double larger = ax > ay ? ax : ay;
    const double smaller = ax > ay ? ay : ax;
    const double inner = unit_atan(smaller / (larger > 0 ? larger : 1));
    const double first = ay > ax ? 1.57079632679489661923 - inner : inner;
    const double half = x < 0 ? 3.14159265358979323846 - first : first;
    return y < 0 ? -half : half;
}

namespace portable {
#include "core/form/term_kernels.inl"
} // namespace portable

#ifdef RHOMBLOOM_X86
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
#include "core/form/term_kernels.inl"
} // namespace avx2
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,prefer-vector-width=512")
namespace avx512 {
#include "core/form/term_kernels.inl"
} // namespace avx512
#pragma GCC pop_options
#endif

const TermKernels& choose()
{
#ifdef RHOMBLOOM_X86
    return best_kernels(portable::table, &avx2::table, &avx512::table);
#else
    return portable::table;
#endif
}

} // namespace

const TermKernels& term_kernels()
{
    static const TermKernels& kernels = choose();
    return kernels;
}

double portable_atan2(double y, double x)
{
    return angle_of(y, x);
}

} // namespace rhombloom
