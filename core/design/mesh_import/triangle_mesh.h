#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "core/model/surface.h"

namespace rhombloom {

using Triangle = std::array<int, 3>;

//! \brief Points and triangles, as read from a file or made by remeshing. Triangles are counter-clockwise seen from
//! outside once a mesh has been repaired; before that nothing is promised.
struct TriangleMesh
{
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
};

//! \brief Twice the area times the unit normal of triangle \p t.
Vec3 area_normal(const TriangleMesh& mesh, const Triangle& t);

double area(const TriangleMesh& mesh);

//! \brief Enclosed volume; negative when the triangles face inward. Meaningful for closed meshes.
double signed_volume(const TriangleMesh& mesh);

Eigen::AlignedBox3d bounds(const TriangleMesh& mesh);

//! \brief Every point p becomes factor * p + shift.
void transform(TriangleMesh& mesh, double factor, const Vec3& shift);

//! \brief Drop the points that no triangle uses and renumber.
void drop_unused_points(TriangleMesh& mesh);

} // namespace rhombloom
