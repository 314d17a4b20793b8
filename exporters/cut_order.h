#pragma once

#include <cstddef>
#include <vector>

#include "exporters/drawing.h"

namespace rhombloom {

//! Which pieces lie beside each other: a symmetric matrix, one row per piece.
using Neighbours = std::vector<std::vector<bool>>;

//! \brief The least distance from \p points to the edges of \p polygon, mm.
double gap(const std::vector<Vec2>& points, const std::vector<Vec2>& polygon);

//! \brief Pieces whose contours come within \p reach (mm) of each other.
Neighbours neighbours(const std::vector<Path>& pieces, double reach);

//! \brief An order of \p starts in which as few as possible follow a neighbour, and then the travel from \p home
//! through all of them is short.
//! \details Thin film warps where one cut follows another before the heat has gone. Nearest next, improved by reversing
//! and moving stretches (2-opt, Or-opt) until nothing helps; a step to a neighbour costs a detour across all pieces.
//! \return Indices into \p starts. The same input gives the same order.
std::vector<std::size_t> cutting_order(const std::vector<Vec2>& starts, const Neighbours& beside, const Vec2& home);

} // namespace rhombloom
