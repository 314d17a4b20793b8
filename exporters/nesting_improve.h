#pragma once

#include "exporters/nesting_layout.h"

namespace rhombloom::nesting {

//! \brief The room cut in two (and one half once more), each part filled with its own fragment: good where a whole
//! number of rows leaves a broad strip. Nothing unless more than \p more_than copies fit.
Layout best_blocks(const Piece& piece, const Room& room, std::size_t more_than);

//! \brief \p layout with more copies wherever the no-fit polygons leave a place, in any allowed direction tried.
//! \details Pushed into each corner in turn; there as it is, and with every copy slid against the others.
Layout topped_up(const Piece& piece, const Room& room, const Layout& layout);

} // namespace rhombloom::nesting
