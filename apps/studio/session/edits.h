#pragma once

#include <Eigen/Geometry>

#include "core/design/design.h"

namespace rhombloom::studio {

//! \brief Move the part \p id rigidly: the operation that made it, and what later operations say about places on it.
//! \details A part of its own follows from one place or layout; extrusions, openings and flips on it go with it.
//! Refuses a part that is unknown or has been merged: there is nothing left to move by itself.
Expected<Design> moved_part(const Design& design, const std::string& id, const Eigen::Isometry3d& motion);

//! \brief Take the part \p id out of the history, with all that was done on it and merged into it.
Expected<Design> without_part(const Design& design, const std::string& id);

//! \brief Rotation about x, then y, then z, degrees: how a design writes it.
Vec3 euler_deg(const Eigen::Matrix3d& rotation);
Eigen::Matrix3d rotation_matrix(const Vec3& euler_deg);

//! \brief The part that \p operation is about; of a merge the one that remains.
const std::string& subject(const Operation& operation);

} // namespace rhombloom::studio
