#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief Give every vertex its side: the proper 2-colouring that long and short sides need (Sec. 3.1).
//! \param first the side of the lowest-numbered vertex of each connected part.
//! \details A mesh with an odd cycle (an odd handle) cannot be built: the refusal names the cycle's vertices.
Expected<std::vector<Side>> tag_sides(int vertex_count, const std::vector<Quad>& quads, Side first = Side::Long);

} // namespace rhombloom
