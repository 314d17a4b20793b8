#pragma once

#include "core/model/triangulation.h"

namespace rhombloom {

//! \file
//! \brief The families of base shapes. Positions are rough (edges about 1 long before scaling); tags are final.

//! \brief One element per edge of a triangulation: its ends are the acute corners, the centres of the triangles beside
//! it the obtuse ones; all front. Any degree of 3 to 6 is buildable; the shape follows the triangulation.
SurfaceLists join(const Triangulation& triangulation);

//! \brief Two n-valent poles and \p rows staggered rows of n elements: n = 3..8, rows = 2... (V = F + 2).
//! \details Each row faces one way; the rows are turned so that the defects spread most evenly.
SurfaceLists polar_stack(int n, int rows, const Element& element);

//! \brief The first \p rows rows of a polar stack: a cup with a sawtooth rim.
SurfaceLists dome(int n, int rows, const Element& element);

//! \brief \p rows staggered rows of n elements without poles: an open tube with two sawtooth rims.
SurfaceLists tube(int n, int rows);

//! \brief \p rows staggered rows of n elements, closed both ways; rows = 6, 10, 14, ... so that top and bottom are
//! alike. \details The outer rows are wide, the inner ones narrow: roundest, with the least stretch, for n about 2
//! rows.
SurfaceLists torus(int n, int rows);

//! \brief A flat patch of \p columns x \p rows elements, facings alternating so that every inner vertex is flat.
SurfaceLists sheet(int columns, int rows);

//! \brief Every element divided into k x k, facings alternating like a checkerboard inside it: the old vertices keep
//! their defects, all new ones are flat.
SurfaceLists subdivide(const SurfaceLists& lists, int k);

} // namespace rhombloom
