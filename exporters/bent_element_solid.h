#pragma once

#include "exporters/bent_element.h"

namespace rhombloom {

//! \brief A bent element with its thickness: a closed surface of triangles, z up, mm.
//! \details Two layers of the flat sheet's points, outer then inner, joined round the rim. The rim's points are shared
//! by faces and edge, with normals leaning outward a little: half a millimetre of edge needs no vertices of its own.
struct SolidElement
{
    std::vector<Vec3> points;
    std::vector<Vec3> normals;
};

SolidElement solid_element(const BentSurface& bent, const BentElement& element, double thickness);

//! \brief The triangles of all solid elements that look outward with the same face, counter-clockwise from outside.
std::vector<std::array<int, 3>> solid_triangles(const FlatSheet& sheet, Outward outward);

} // namespace rhombloom
