// A file of its own: overlap.h and triangle_mesh.h each have their Triangle.
#include "core/design/mesh_import/network_crossings.h"

#include "core/design/overlap.h"

namespace rhombloom {

bool has_crossings(const Surface& surface)
{
    return crosses_itself(surface);
}

} // namespace rhombloom
