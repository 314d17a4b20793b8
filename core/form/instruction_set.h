#pragma once

//! \file
//! Included by sources that compile their inner loops once per instruction set, in the namespaces portable, avx2 and
//! avx512, the latter two where RHOMBLOOM_X86 is defined.

#if defined(__x86_64__) && defined(__GNUC__)
#define RHOMBLOOM_X86 1
#endif

namespace rhombloom {

//! \brief The table of kernels for the best instruction set that this machine has; null pointers: not compiled.
template <class Kernels>
const Kernels& best_kernels(const Kernels& portable, const Kernels* avx2, const Kernels* avx512)
{
#ifdef RHOMBLOOM_X86
    if (avx512 != nullptr && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
        return *avx512;
    }
    if (avx2 != nullptr && __builtin_cpu_supports("avx2")) {
        return *avx2;
    }
#endif
    return portable;
}

} // namespace rhombloom
