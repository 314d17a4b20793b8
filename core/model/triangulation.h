#pragma once

#include <array>
#include <vector>

#include "core/model/surface.h"

namespace rhombloom {

//! \brief A closed, oriented triangulation of the sphere: what joins are made from. Triangles counter-clockwise seen
//! from outside.
struct Triangulation
{
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles;
};

//! The three regular polyhedra with triangular faces.
enum class Deltahedron
{
    Tetrahedron,
    Octahedron,
    Icosahedron
};

//! \brief The geodesic triangulation of type (a, b) on the unit sphere: T = a^2 + ab + b^2 triangles for each face of
//! the polyhedron (Goldberg, Caspar and Klug). Point 0 is a corner of the polyhedron.
Triangulation geodesic(Deltahedron base, int a, int b);

//! \brief Convex hull of points in general position on a sphere, as a triangulation of all of them.
Triangulation sphere_hull(std::vector<Vec3> points);

} // namespace rhombloom
