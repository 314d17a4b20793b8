#include "core/model/element_stretch.h"

#include <algorithm>
#include <array>

namespace rhombloom {

namespace {

//! (l - L) / L of the four sides and the two diagonals.
std::array<double, 6> stretches(const Surface& surface, const Element& element, Face f)
{
    const Quad q = quad(surface, f);
    const auto stretch = [&](int i, int k, double rest) {
        return (surface.point(Vertex(q[i])) - surface.point(Vertex(q[k]))).norm() / rest - 1;
    };
    std::array<double, 6> result{};
    for (int k = 0; k < 4; ++k) {
        result[k] = stretch(k, (k + 1) % 4, side_length(element, surface.data(Vertex(q[k])).side));
    }
    for (int k = 0; k < 2; ++k) {
        const bool acute = corner_angle(surface, element, f, Vertex(q[k])) < pi / 2;
        result[4 + k] = stretch(k, k + 2, acute ? long_diagonal(element) : short_diagonal(element));
    }
    return result;
}

} // namespace

double element_stretch(const Surface& surface, const Element& element, Face f)
{
    const std::array<double, 6> all = stretches(surface, element, f);
    return *std::max_element(all.begin(), all.end());
}

double element_compression(const Surface& surface, const Element& element, Face f)
{
    const std::array<double, 6> all = stretches(surface, element, f);
    return -*std::min_element(all.begin(), all.end());
}

} // namespace rhombloom
