// A file of its own: overlap.h and triangle_mesh.h each have their Triangle.
#include "core/design/mesh_import/network_crossings.h"

#include "core/design/overlap.h"

namespace rhombloom {

int crossings(const Surface& surface)
{
    return static_cast<int>(self_intersections(surface).size());
}

} // namespace rhombloom
