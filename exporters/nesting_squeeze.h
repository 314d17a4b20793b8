#pragma once

#include "exporters/nesting_layout.h"

namespace rhombloom::nesting {

//! \brief One copy more than \p layout has, or nothing when the search finds none.
//! \details Sets out from patterns and rows for a room slightly too large, shrunk into this one, and from \p layout
//! with a copy too many; then all copies move and turn at once until none overlaps. Work is bounded by the number of
//! copies and boundary points; sheets with very many copies are left as they are.
Layout squeezed(const Piece& piece, const Room& room, const Layout& layout);

} // namespace rhombloom::nesting
