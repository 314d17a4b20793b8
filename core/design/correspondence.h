#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "core/design/interface.h"

namespace rhombloom {

//! \brief A one-to-one, monotonic matching of two loops of equal size (Sec. 4.1).
//! \details The kept elements lie to the left of both, so the loops run in opposite directions where they are glued:
//! vertex i of the fixed loop meets vertex (shift - i) mod n of the moving one.
struct Correspondence
{
    int shift = 0;
    double min_defect = 0; //!< of the merged vertices and of the valleys zipped before
    double max_defect = 0;
};

//! \brief The vertex of the moving loop that meets vertex \p i of the fixed one.
int partner(const Correspondence& match, int i, int size);

//! \brief The correspondence of that shift if it is compatible: each merged vertex has a permissible defect.
//! \pre the loops have the same size.
std::optional<Correspondence> correspondence(const Interface& fixed, const Interface& moving, int shift,
                                             const DefectRange& limits);

//! \brief Every compatible correspondence. The one seeded by the closest
//! pair of vertices comes first, the others in the order of the shift.
//! \details Sides never obstruct: the sides of two loops alternate, so all match or all differ, and in the second case
//! one part is swapped (see apply_graft). Empty when the sizes differ or no shift is compatible.
std::vector<Correspondence> correspondences(const Interface& fixed, const Interface& moving, const DefectRange& limits);

//! \brief The rigid motion that brings the moving loop closest to the fixed one (least squares).
Eigen::Isometry3d alignment(const Interface& fixed, const Interface& moving, const Correspondence& match);

//! \brief Root mean square distance (mm) of the matched vertices after \p pose has moved the moving loop.
double misfit(const Interface& fixed, const Interface& moving, const Correspondence& match,
              const Eigen::Isometry3d& pose);

} // namespace rhombloom
