#pragma once

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

struct GapOptions
{
    double width = 1; //!< of the widest gap that is filled, in the mesh's unit
    double edge = 1;  //!< length of the triangles' sides
};

struct GapsClosed
{
    TriangleMesh mesh;
    double share = 0; //!< of the area that lay in gaps; 0 where nothing has changed
};

//! \brief \p even (triangles with sides of that length) with gaps, slots and the holes of handles filled that are
//! narrower than that: walls so near each other would cross.
//! \details A morphological closing (Serra 1982) by half the width, on a grid (mesh_wrap.h). Nothing is changed where
//! next to nothing of the area lies in gaps and no handle goes, where parts that meet would make a new one, and where
//! the grid would be too large.
GapsClosed close_gaps(const TriangleMesh& even, const GapOptions& options);

} // namespace rhombloom
