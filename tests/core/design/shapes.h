#pragma once

#include "core/design/pose.h"
#include "core/model/base_shapes.h"

namespace rhombloom::shapes {

inline BaseShape embedded(const std::string& name, const Element& element = {})
{
    BaseShape shape = *base_shape(name, element);
    embed_in_place(shape.surface, element, {});
    return shape;
}

inline bool is_closed(const Surface& surface)
{
    for (const Halfedge h : surface.halfedges()) {
        if (surface.is_boundary(h)) {
            return false;
        }
    }
    return true;
}

//! Names of the library's shapes of at most \p elements elements.
inline std::vector<std::string> small_shapes(int elements)
{
    std::vector<std::string> result;
    for (const std::string& name : base_shape_names()) {
        if (static_cast<int>(base_shape(name, Element{})->surface.n_faces()) <= elements) {
            result.push_back(name);
        }
    }
    return result;
}

inline Vec3 outward(const Surface& surface, Vertex v)
{
    Vec3 n = Vec3::Zero();
    for (const Face f : surface.vf_range(v)) {
        const Quad q = quad(surface, f);
        const auto at = [&](int k) { return surface.point(Vertex(q[k])); };
        n += (at(2) - at(0)).cross(at(3) - at(1)).normalized();
    }
    return n.normalized();
}

} // namespace rhombloom::shapes
