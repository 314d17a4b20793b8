#pragma once

#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

//! \brief How each corner of a network lies turned, against where it was meant to be.
//! \details The rotation that brings the corners up to two edges around nearest to where they settled (orthogonal
//! Procrustes problem). \p meant are the points of \p settled on the target.
std::vector<Eigen::Matrix3d> turns(const TriangleMesh& settled, const std::vector<Vec3>& meant);

//! \brief Points in the pose nearest to where they were meant to be, and how far from there they are then, rms.
struct Strayed
{
    Eigen::Affine3d pose;
    double rms = 0;
};

//! \brief Corresponding points fitted by a similarity transform (Umeyama 1991); \p rescale false: by a rigid motion.
Strayed astray(const std::vector<Vec3>& settled, const std::vector<Vec3>& meant, bool rescale);

} // namespace rhombloom
