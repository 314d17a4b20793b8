#pragma once

#include "core/form/attempt.h"

namespace rhombloom {

//! \brief Look for a lower equilibrium near \p best: pull one vertex after the other through the surface around it, out
//! and in, let go, and keep what is lower in the end.
//! \details Where creases and limbs meet, single vertices can be in or out, seams tilt one way or the other, and sheets
//! bend along one diagonal or the other; both are equilibria, a thousandth apart. Each trial is a Newton solve of the
//! two rings around the vertex, with it held and then without; only what ends elsewhere and hardly higher is followed
//! up for the whole surface. Only vertices near concave hinges are tried, until none of them finds anything.
//! Does nothing on more than 2,000 vertices. Deterministic.
void lower_equilibrium(const EmbeddingTerms& terms, Attempt& best, const MinimiseOptions& options);

} // namespace rhombloom
