#pragma once

#include <string>
#include <vector>

#include "exporters/kerf.h"
#include "exporters/outline.h"

namespace rhombloom {

//! \brief One measured fact about the hooks.
struct HookCheck
{
    std::string id;   //!< "C1" .. "C13"
    std::string name; //!< e.g. "finger clearance at a node"
    bool ok = false;
    double value = 0;     //!< what was measured, in \p unit
    double limit = 0;     //!< what it is compared with
    std::string unit;     //!< "mm", "%", "deg" or "" for counts
    std::string sentence; //!< the number, and when not ok what to change
};

struct HookCheckOptions
{
    Kerf kerf;
    double strain_limit = 0.03;        //!< of the material when a long side is bowed or inserted
    double finger_strain_limit = 0.03; //!< of the material in a finger (C3, C10)
};

//! \brief The checks C1 to C13, in this order, for the actual parameters; C1, C2, C12 and C13 on the real outline.
//! \details C12 allows 0.5 mm of play in every direction but straight inwards, where the neck meets the slit's bottom
//! only after `cn + sqrt(cs (s - cs))` (0.59 mm for the default piece): there the slit's width is allowed. A piece
//! without a barb need not be held straight outwards. A piece whose contour cannot be drawn at all fails C1 with the
//! outline's own sentence and has no further entries.
std::vector<HookCheck> hook_checks(const HookParameters& parameters, const HookCheckOptions& options = {});

//! \brief Refuse parameters that fail a check, with the first such check's id and sentence.
Expected<void> check(const HookParameters& parameters, const HookCheckOptions& options = {});

} // namespace rhombloom
