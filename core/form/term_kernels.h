#pragma once

#include "core/form/embedding_terms.h"

namespace rhombloom {

//! Energies in units of la; both are summed in eight interleaved parts in the order of the terms.
struct TermEnergy
{
    double energy = 0;
    double guard = 0; //!< barrier or ridge
};

//! \brief Energy of all springs or all hinges at the positions \p x, and their gradient, added to \p gradient.
//! \details Vectorised for SSE2, AVX2 and AVX-512 with the same bytes as result: each term goes through the same
//! operations, none of them fused, and the angle is computed here, not by the C library.
struct TermKernels
{
    TermEnergy (*springs)(const EmbeddingTerms& terms, const double* x, double* gradient);
    TermEnergy (*hinges)(const EmbeddingTerms& terms, const double* x, double* gradient);
};

//! \brief The fastest kernels that this machine can run.
const TermKernels& term_kernels();

//! \brief atan2 by a rational approximation (after Cephes), within 2 units in the last place.
double portable_atan2(double y, double x);

} // namespace rhombloom
