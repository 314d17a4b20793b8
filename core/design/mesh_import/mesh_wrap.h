#pragma once

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

struct WrapOptions
{
    double cell = 1;    //!< side of a grid cell, in the mesh's unit: detail below two cells is lost
    double closing = 0; //!< gaps narrower than twice this are filled, and what they enclose
};

//! \brief The surface of the solid that \p tree encloses: all points with a winding number above one half.
//! \details Marching tetrahedra on a regular grid (Doi and Koide 1991), then points that are near the mesh are drawn
//! onto it. The result consists of closed oriented manifolds; it is empty when nothing is enclosed.
TriangleMesh wrap(const MeshTree& tree, const WrapOptions& options);

} // namespace rhombloom
