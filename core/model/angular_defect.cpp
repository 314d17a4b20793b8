#include "core/model/angular_defect.h"

#include <algorithm>

namespace rhombloom {

double angular_defect(const Surface& surface, const Element& element, Vertex v)
{
    expects(!surface.is_boundary(v), "angular_defect: v is an interior vertex");
    double defect = two_pi;
    for (const Face f : surface.vf_range(v)) {
        defect -= corner_angle(surface, element, f, v);
    }
    return defect;
}

int valence(const Surface& surface, Vertex v)
{
    int count = 0;
    for (const Face f : surface.vf_range(v)) {
        count += f.is_valid() ? 1 : 0;
    }
    return count;
}

DefectRange defect_range(const Surface& surface, const Element& element)
{
    std::vector<double> defects;
    for (const Vertex v : surface.vertices()) {
        if (!surface.is_boundary(v)) {
            defects.push_back(angular_defect(surface, element, v));
        }
    }
    if (defects.empty()) {
        return {};
    }
    const auto [min, max] = std::minmax_element(defects.begin(), defects.end());
    return {*min, *max};
}

} // namespace rhombloom
