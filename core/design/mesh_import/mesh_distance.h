#pragma once

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

//! \brief Distances of one surface's points to another surface, mm.
struct Deviation
{
    double rms = 0;
    double max = 0;
};

//! \brief How far a network is from its target, both ways.
struct Distance
{
    Deviation to_target;   //!< from points spread evenly over the elements
    Deviation from_target; //!< from points spread evenly over the target

    //! Both directions together, mm.
    double rms() const;
};

//! \brief The elements as triangles: four each, about their middle.
TriangleMesh element_triangles(const Surface& surface);

//! \brief Points spread evenly over a mesh: about \p count of them, always the same ones.
std::vector<Vec3> sample(const TriangleMesh& mesh, int count);

//! \brief Distance of a network from its target, by \p samples points on each.
Distance distance(const Surface& surface, const MeshTree& target, int samples = 6000);

//! \brief A pose of a surface, and how far from the target that is.
struct Fit
{
    Eigen::Affine3d pose;
    Distance distance; //!< by 1,500 points on each
};

//! \brief The similarity transform that brings \p surface nearest to \p target; with \p rescale false a rigid motion.
//! \details Iterated closest points (Besl and McKay 1992) from the present pose: from points of the surface to the
//! target; where that does not come close, from points of either to the other as well: one way alone shrinks a surface
//! whose limbs point elsewhere than its target's.
Fit fit(const Surface& surface, const MeshTree& target, bool rescale);

} // namespace rhombloom
