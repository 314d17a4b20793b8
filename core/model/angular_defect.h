#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief 2 pi minus the sum of the corner angles at interior vertex \p v: its Gaussian curvature (Eq. 1). Radians.
//! \pre v is not on the boundary.
double angular_defect(const Surface& surface, const Element& element, Vertex v);

//! \brief Number of elements that meet at \p v.
int valence(const Surface& surface, Vertex v);

//! \brief Smallest and largest defect of the interior vertices; {0, 0} when there are none.
DefectRange defect_range(const Surface& surface, const Element& element);

} // namespace rhombloom
