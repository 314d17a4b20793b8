#pragma once

#include <vector>

#include "exporters/outline.h"

namespace rhombloom::tests {

inline Element element_of(double la, double thickness, double ratio = 1.1, double alpha_deg = 63.435)
{
    Element element;
    element.la = la;
    element.lb = ratio * la;
    element.alpha = radians(alpha_deg);
    element.thickness = thickness;
    return element;
}

//! The sizes the hook was designed for, small film to large lamp.
inline std::vector<Element> table_elements()
{
    return {element_of(40, 0.25), element_of(60, 0.3),  element_of(80, 0.5),
            element_of(100, 0.5), element_of(120, 0.8), element_of(200, 0.8)};
}

} // namespace rhombloom::tests
