#pragma once

#include <cstdint>

#include "exporters/nesting_polygon.h"

//! The only place of the nesting that knows Clipper (polygons on an integer grid).
namespace rhombloom::nesting {

//! Grid points per mm: decimal numbers stay exact, and 268 mm fit in Clipper's fast range.
inline constexpr double grid = 4e6;

std::int64_t to_grid(double mm);

//! \brief Contours of the region with a winding number other than zero; outer ones counter-clockwise, holes clockwise.
std::vector<Polygon> united(const std::vector<Polygon>& rings);

//! \brief What is left of \p region (contours as from united) outside \p holes.
std::vector<Polygon> without(const std::vector<Polygon>& region, const std::vector<Polygon>& holes);

//! \brief The largest outer contour of the region with a positive winding number.
Polygon outer_contour(const Polygon& ring);

} // namespace rhombloom::nesting
