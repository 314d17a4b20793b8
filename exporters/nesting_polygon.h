#pragma once

#include <vector>

#include "core/expected.h"
#include "exporters/drawing.h"

//! Polygons as the nesting uses them: closed, counter-clockwise, the closing point not repeated; mm.
namespace rhombloom::nesting {

using Polygon = std::vector<Vec2>;

//! \brief A rotation whose quarter turns are exact.
struct Turn
{
    double c = 1;
    double s = 0;

    Vec2 operator*(const Vec2& p) const { return {c * p.x() - s * p.y(), s * p.x() + c * p.y()}; }
};

//! \brief The rotation by \p angle (radians); cosine and sine are exact for multiples of a right angle.
Turn turn(double angle);

//! \brief How a copy lies: first mirrored in the y axis (x becomes -x) if \p mirrored, then turned by \p angle.
struct Orientation
{
    double angle = 0;
    bool mirrored = false;
};

//! \brief \p polygon in an orientation, counter-clockwise again.
Polygon oriented(const Polygon& polygon, const Orientation& orientation);

//! \brief mm2, positive counter-clockwise.
double signed_area(const Polygon& polygon);

Box box_of(const Polygon& polygon);

//! \brief Counter-clockwise, no three points in a line.
Polygon convex_hull(Polygon points);

//! \brief The \p count longest edges as vectors, longest first.
std::vector<Vec2> long_edges(const Polygon& polygon, std::size_t count);

//! \brief Refuse fewer than three points, numbers that are not finite, no area, touching or crossing edges.
Expected<void> check_simple(const Polygon& polygon);

//! \brief Does the boundary of \p a touch or cross that of \p b?
bool boundaries_meet(const Polygon& a, const Polygon& b);

//! \brief A polygon that contains every point closer than \p radius to \p polygon, exactly \p radius away along the
//! edges and at most \p slack more at rounded corners. Cavities that close are filled.
Polygon inflated(const Polygon& polygon, double radius, double slack);

//! \brief A polygon with fewer vertices that contains \p polygon and keeps within \p tolerance (mm) of it.
Polygon simplified_outward(const Polygon& polygon, double tolerance);

} // namespace rhombloom::nesting
