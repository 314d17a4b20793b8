#pragma once

#include "core/design/mesh_import/triangle_mesh.h"
#include "core/model/element.h"

namespace rhombloom {

//! \brief A target made ready for the search of a network.
struct WorkingTarget
{
    TriangleMesh even;    //!< the target in triangles that are small for the network and of one size
    TriangleMesh thick;   //!< the same with thin parts as thick as elements can follow, and narrow gaps filled
    double scale = 1;     //!< of both, relative to the target that was given, about the origin
    double thickened = 0; //!< share of the area that was too thin
    double filled = 0;    //!< share of the area that lay in gaps that were too narrow
    int elements = 0;     //!< that cover the thickened target
};

//! \brief The thinnest wall or limb that a network follows, mm.
double least_thickness(const Element& element);

//! \brief The narrowest gap that a network leaves open, mm.
double least_gap_width(const Element& element);

//! \brief \p target, thickened, for a network whose triangles have sides of length \p edge.
//! \param elements that are to cover it: it is scaled to suit them; 0: it stays as large as it is
WorkingTarget working_target(const TriangleMesh& target, double edge, int elements);

} // namespace rhombloom
