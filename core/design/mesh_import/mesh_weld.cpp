#include "core/design/mesh_import/mesh_weld.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace rhombloom {

namespace {

constexpr double weld_share = 1e-7;    // of the diagonal: points this near are one
constexpr std::size_t large = 200'000; // triangles: from then on most of the time goes by waiting for the memory
constexpr int low_bits = 8;            // of a cell's place along an axis, which has 24, that the curve leaves out

using Cell = std::array<std::int32_t, 3>; // of the grid on which points are one

//! The 16 lowest bits of \p number, two zeros between them: halves, quarters ... are moved apart.
std::uint64_t spread_bits(std::uint64_t number)
{
    number = (number | number << 16) & 0xff0000ffU;
    number = (number | number << 8) & 0xf00f00f00fU;
    number = (number | number << 4) & 0xc30c30c30c3U;
    return (number | number << 2) & 0x249249249249U;
}

//! The place of a cell along a space-filling curve (Morton 1966).
std::uint64_t curve_place(const Cell& cell)
{
    std::uint64_t result = 0;
    for (int axis = 0; axis < 3; ++axis) {
        result |= spread_bits(static_cast<std::uint64_t>(cell[axis] >> low_bits)) << axis;
    }
    return result;
}

struct Place
{
    std::uint64_t on_curve = 0;
    Cell cell{};
    int point = 0;

    bool operator<(const Place& other) const
    {
        return std::tie(on_curve, cell, point) < std::tie(other.on_curve, other.cell, other.point);
    }
};

void sort_triangles(TriangleMesh& mesh)
{
    for (Triangle& t : mesh.triangles) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    }
    std::sort(mesh.triangles.begin(), mesh.triangles.end());
}

} // namespace

void weld(TriangleMesh& mesh)
{
    const Eigen::AlignedBox3d box = bounds(mesh);
    const double width = weld_share * box.diagonal().norm();
    if (!(width > 0)) {
        return;
    }
    std::vector<Place> places;
    places.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) {
        const Vec3 q = ((p - box.min()) / width).array().round();
        const Cell cell = {static_cast<int>(q.x()), static_cast<int>(q.y()), static_cast<int>(q.z())};
        places.push_back({curve_place(cell), cell, static_cast<int>(places.size())});
    }
    std::sort(places.begin(), places.end());
    const bool reorder = mesh.triangles.size() > large;
    std::vector<Vec3> points;
    std::vector<int> number(mesh.points.size());
    int first = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i == 0 || places[i].cell != places[i - 1].cell) {
            first = reorder ? static_cast<int>(points.size()) : places[i].point;
            points.push_back(mesh.points[places[i].point]);
        }
        number[places[i].point] = first;
    }
    for (Triangle& t : mesh.triangles) {
        t = {number[t[0]], number[t[1]], number[t[2]]};
    }
    if (reorder) {
        mesh.points = std::move(points);
        sort_triangles(mesh);
    }
    drop_unused_points(mesh);
}

} // namespace rhombloom
