#include "exporters/pdf_grid.h"

#include <cmath>

namespace rhombloom {

namespace {

Vec2 rounded(const Vec2& p, double unit)
{
    return (p / unit).array().round() * unit;
}

//! The corner that cairo would leave out, because it falls on a neighbour or lies in line with both; -1: there is none.
int vanishing_corner(const Polygon& p)
{
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 in = p[i] - p[(i + n - 1) % n];
        const Vec2 out = p[(i + 1) % n] - p[i];
        if (in.x() * out.y() == in.y() * out.x()) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

Polygon all_rounded(const Polygon& points, double unit)
{
    Polygon result;
    for (const Vec2& p : points) {
        result.push_back(rounded(p, unit));
    }
    return result;
}

} // namespace

Polygon on_grid(const Polygon& points, bool closed)
{
    Polygon result = all_rounded(points, 1.0 / 16);
    if (!closed || vanishing_corner(result) < 0) {
        return result;
    }
    result = all_rounded(points, 1.0 / 256);
    const int i = vanishing_corner(result);
    if (i >= 0) {
        const Vec2 along = result[(i + 1) % result.size()] - result[(i + result.size() - 1) % result.size()];
        result[i] += std::abs(along.x()) > std::abs(along.y()) ? Vec2(0, 1.0 / 64) : Vec2(1.0 / 64, 0);
    }
    return result;
}

} // namespace rhombloom
