#pragma once

#include "exporters/nesting_layout.h"

namespace rhombloom::nesting {

//! \brief Rows parallel to the room's lower side, each with its own shift and drawn or turned by 180 degrees.
//! \details Stacked from the bottom by beam search: the next row lies where its skyline over the last one is lowest, or
//! flush with the left or right side. Each row takes as many copies as its shift leaves room for.
//! \param angle  of the drawn copies
Layout stacked_rows(const Piece& piece, const Room& room, double angle);

//! \brief The best of stacked_rows() along either side of the room over many angles, if it has more than
//! \p more_than copies.
Layout best_rows(const Piece& piece, const Room& room, std::size_t more_than);

} // namespace rhombloom::nesting
