#pragma once

#include <vector>

#include "exporters/bent_element.h"

namespace rhombloom {

//! \brief An edge of the flat sheet's triangles; its length (mm) is to be kept when the sheet is bent.
struct SheetEdge
{
    int a;
    int b;
    double length;
    double stiffness; //!< grows with the density of the points
    bool rim;         //!< on the outline
};

std::vector<SheetEdge> sheet_edges(const FlatSheet& sheet, const Element& element);

//! \brief The 99th percentile of |bent/flat - 1| over all edges of all elements.
double p99_distortion(const BentSurface& bent, const std::vector<SheetEdge>& segments);

} // namespace rhombloom
