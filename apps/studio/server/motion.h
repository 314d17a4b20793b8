#pragma once

#include <Eigen/Geometry>

#include "core/design/json_reader.h"

namespace rhombloom::studio {

//! \brief Read a rigid motion: `move_mm`, and `turn` (a quaternion [x, y, z, w]) about the point `about_mm`.
//! \details First the turn, then the move. Anything left out is the identity.
Expected<Eigen::Isometry3d> take_motion(ObjectReader& body);

//! \brief The surface moved rigidly.
Surface moved(Surface surface, const Eigen::Isometry3d& motion);

} // namespace rhombloom::studio
