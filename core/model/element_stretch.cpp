#include "core/model/element_stretch.h"

#include <algorithm>

namespace rhombloom {

double element_stretch(const Surface& surface, const Element& element, Face f)
{
    const Quad q = quad(surface, f);
    const auto stretch = [&](int i, int k, double rest) {
        return (surface.point(Vertex(q[i])) - surface.point(Vertex(q[k]))).norm() / rest - 1;
    };
    double largest = -1;
    for (int k = 0; k < 4; ++k) {
        largest = std::max(largest, stretch(k, (k + 1) % 4, side_length(element, surface.data(Vertex(q[k])).side)));
    }
    for (int k = 0; k < 2; ++k) {
        const bool acute = corner_angle(surface, element, f, Vertex(q[k])) < pi / 2;
        largest = std::max(largest, stretch(k, k + 2, acute ? long_diagonal(element) : short_diagonal(element)));
    }
    return largest;
}

} // namespace rhombloom
