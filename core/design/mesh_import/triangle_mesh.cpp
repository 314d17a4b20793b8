#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

Vec3 area_normal(const TriangleMesh& mesh, const Triangle& t)
{
    const Vec3& a = mesh.points[t[0]];
    return (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a);
}

double area(const TriangleMesh& mesh)
{
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        sum += area_normal(mesh, t).norm() / 2;
    }
    return sum;
}

double signed_volume(const TriangleMesh& mesh)
{
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        sum += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6;
    }
    return sum;
}

Eigen::AlignedBox3d bounds(const TriangleMesh& mesh)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& p : mesh.points) {
        box.extend(p);
    }
    return box;
}

void transform(TriangleMesh& mesh, double factor, const Vec3& shift)
{
    for (Vec3& p : mesh.points) {
        p = factor * p + shift;
    }
}

void drop_unused_points(TriangleMesh& mesh)
{
    std::vector<int> number(mesh.points.size(), -1);
    for (const Triangle& t : mesh.triangles) {
        for (const int v : t) {
            number[v] = 0;
        }
    }
    int next = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == 0) {
            mesh.points[next] = mesh.points[v];
            number[v] = next++;
        }
    }
    mesh.points.resize(next);
    for (Triangle& t : mesh.triangles) {
        for (int& v : t) {
            v = number[v];
        }
    }
}

} // namespace rhombloom
