#pragma once

#include "core/model/surface.h"

namespace rhombloom {

using Triangle = std::array<Vec3, 3>;

//! \brief The two triangles of an element, split along the shorter diagonal.
std::array<Triangle, 2> triangles(const Surface& surface, Face f);

//! \brief Smallest distance of two triangles; 0 when they cross. Coplanar and degenerate ones need no special care.
double distance(const Triangle& a, const Triangle& b);

//! \brief Distance of a point from a triangle.
double distance(const Vec3& p, const Triangle& t);

//! \brief Two posed surfaces: which elements of each touch or cross the other (Sec. 4.2).
struct Overlap
{
    std::vector<char> a; //!< one entry per element of the first surface
    std::vector<char> b;
    bool any = false;
};

//! \brief Elements whose triangles come closer than \p touching (mm) count as intersecting.
Overlap overlap(const Surface& a, const Surface& b, double touching);

//! \brief The generalised winding number of \p surface at \p p: 1 inside, 0 outside, in between near an opening.
double winding_number(const Surface& surface, const Vec3& p);

//! \brief Distance of \p p from \p surface, positive outside, mm.
double signed_distance(const Surface& surface, const Vec3& p);

//! \brief The same for many points at once, which is much faster.
std::vector<double> signed_distances(const Surface& surface, const std::vector<Vec3>& points);

//! \brief Root mean square distance of the vertices of \p surface from the nearest of \p others, mm.
double rms_distance(const Surface& surface, const std::vector<Surface>& others);

//! \brief Do any two elements of one surface cross each other? Neighbours may touch where they are hooked.
bool crosses_itself(const Surface& surface);

} // namespace rhombloom
