#pragma once

#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

//! \brief How each corner of a network lies turned, against where it was meant to be.
//! \details The rotation that brings the corners up to two edges around nearest to where they settled (orthogonal
//! Procrustes problem). \p meant are the points of \p settled on the target.
std::vector<Eigen::Matrix3d> turns(const TriangleMesh& settled, const std::vector<Vec3>& meant);

//! \brief Distance of points from where they were meant to be after a similarity transform, rms; \p rescale false:
//! after a rigid motion.
double astray(const std::vector<Vec3>& settled, const std::vector<Vec3>& meant, bool rescale);

} // namespace rhombloom
