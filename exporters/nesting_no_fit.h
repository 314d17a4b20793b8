#pragma once

#include <vector>

#include "exporters/nesting_polygon.h"

namespace rhombloom::nesting {

//! \brief The no-fit region of two polygons: every offset at which the second overlaps the first.
//! \details Contours are closed; outer ones counter-clockwise, holes (offsets at which the second fits into a cavity)
//! clockwise. Exact to 3e-7 mm.
struct NoFit
{
    std::vector<Polygon> contours;
    Box box;
    double reach = 0; //!< largest distance of a contour point from the origin
};

//! \brief Offsets t at which \p moving + t overlaps \p fixed: the Minkowski sum of fixed and -moving.
//! \details Traced as the convolution of the two boundaries (Guibas, Ramshaw, Stolfi 1983): a point lies in the sum
//! exactly where the winding number of that closed curve is not zero.
NoFit no_fit(const Polygon& fixed, const Polygon& moving);

//! \brief The union of no-fit regions, each moved by its offset.
struct MovedNoFit
{
    const NoFit* region = nullptr;
    Vec2 offset = Vec2::Zero();
    bool negated = false; //!< use -region instead
};
NoFit united(const std::vector<MovedNoFit>& regions);

//! \brief The region turned by \p t about the origin.
NoFit turned(const NoFit& region, const Turn& t);

//! \brief How far the region reaches from the origin along the unit vector \p direction.
double reach_along(const NoFit& region, const Vec2& direction);

//! \brief Is the offset \p p an overlap deeper than \p tolerance (mm)?
bool overlaps(const NoFit& region, const Vec2& p, double tolerance = 1e-7);

} // namespace rhombloom::nesting
