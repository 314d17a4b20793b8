#pragma once

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

struct ThickenOptions
{
    double radius = 1; //!< no part is to be thinner than twice this, in the mesh's unit
    double edge = 1;   //!< length of the triangles' sides
};

struct ThickenedMesh
{
    TriangleMesh mesh;
    double share = 0; //!< of the area that was too thin; 0 where it is next to nothing, and nothing has changed
};

//! \brief \p even (triangles with sides of that length) with its thin parts made thicker, of the same topology.
//! \details Where a wall or limb is thinner than twice the radius, its surface moves outward by what is missing, step
//! by step, with the triangles evened out in between; where another part is near, not so far that the two would meet. A
//! sheet becomes a cushion, a thin limb a sausage.
ThickenedMesh thicken(const TriangleMesh& even, const ThickenOptions& options);

} // namespace rhombloom
