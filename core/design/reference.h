#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief How a design names a vertex or an element: by its number after the previous operation, as the nearest to a
//! point, or as the nearest to a direction.
struct Reference
{
    enum class Kind
    {
        Number,
        Near,
        Toward
    };
    Kind kind = Kind::Number;
    int number = 0;
    Vec3 point = Vec3::Zero(); //!< Near: mm. Toward: a direction, seen from the middle of the surface
};

//! \brief The vertex meant. Nearest to a direction: the smallest angle between it and the way from the surface's
//! middle; among equals the farthest out. Refuses a number that does not exist.
Expected<Vertex> find_vertex(const Surface& surface, const Reference& reference);

//! \brief The same for elements, judged by their centres.
Expected<Face> find_element(const Surface& surface, const Reference& reference);

//! \brief The mean of the corners of \p f, mm.
Vec3 centre(const Surface& surface, Face f);

} // namespace rhombloom
