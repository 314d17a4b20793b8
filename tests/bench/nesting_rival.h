#pragma once

#include <vector>

#include "exporters/nesting.h"

namespace rhombloom {

struct RivalResult
{
    int per_sheet = 0; //!< on the fullest sheet
    int sheets = 0;
};

enum class RivalStart
{
    Corner,
    Centre
};

//! \brief libnest2d on the convex hull of \p outline, four rotations, the spacing of \p options.
RivalResult libnest2d_on_hulls(const std::vector<Vec2>& outline, const NestOptions& options, RivalStart start);

} // namespace rhombloom
