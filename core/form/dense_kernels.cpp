#include "core/form/dense_kernels.h"

#include "core/form/instruction_set.h"

namespace rhombloom {

namespace {

namespace portable {
constexpr int lanes = 2;
constexpr int paired = 1;
#include "core/form/dense_kernels.inl"
} // namespace portable

#ifdef RHOMBLOOM_X86
#pragma GCC push_options
#pragma GCC target("avx2")
namespace avx2 {
constexpr int lanes = 4;
constexpr int paired = 1;
#include "core/form/dense_kernels.inl"
} // namespace avx2
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,prefer-vector-width=512")
namespace avx512 {
constexpr int lanes = 8;
constexpr int paired = 2;
#include "core/form/dense_kernels.inl"
} // namespace avx512
#pragma GCC pop_options
#endif

const DenseKernels& choose()
{
#ifdef RHOMBLOOM_X86
    return best_kernels(portable::table, &avx2::table, &avx512::table);
#else
    return portable::table;
#endif
}

} // namespace

const DenseKernels& dense_kernels()
{
    static const DenseKernels& kernels = choose();
    return kernels;
}

} // namespace rhombloom
