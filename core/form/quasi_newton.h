#pragma once

#include "core/form/limited_memory.h"
#include "core/form/minimise.h"

namespace rhombloom {

//! \brief One step of a quasi-Newton method; false when no way down is left, not even without the memory.
bool quasi_newton_step(const EmbeddingTerms& terms, Iterate& iterate, LimitedMemory& memory,
                       const LimitedMemory::Seed& seed);

} // namespace rhombloom
