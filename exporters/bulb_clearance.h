#pragma once

#include <string>
#include <vector>

#include "core/model/surface.h"

namespace rhombloom {

//! \brief The outside of a bulb: a capsule that contains it, from the top of its cap to its tip. mm.
struct Bulb
{
    std::string name;
    double diameter = 0;
    double length = 0; //!< at least the diameter
};

//! \brief Common bulbs: A60, G95, G125, C35, P45.
const std::vector<Bulb>& common_bulbs();

//! \brief A bulb in a lamp: its base and the direction in which it points (a unit vector), mm.
struct BulbPose
{
    Vec3 base = Vec3::Zero();
    Vec3 direction = Vec3(0, 0, -1);
};

//! \brief Smallest distance between the bulb and the surface's elements, mm; negative when they touch.
//! \details A quad is taken as the tetrahedron of its four corners' triangles (both diagonals), so that the bent
//! element's hull and not one of its folds is measured; the bow of the long sides leans outwards and only adds room.
double bulb_clearance(const Surface& surface, const Bulb& bulb, const BulbPose& pose);

//! mm between a bulb and the elements that a lamp should have.
inline constexpr double least_bulb_clearance = 30;

//! A bulb and its clearance when it hangs, pointing down, with its middle in the middle of the surface's bounds.
struct BulbFit
{
    Bulb bulb;
    double clearance = 0; //!< mm, see bulb_clearance()
};

//! \brief The common bulbs in the middle of the surface; none when the middle does not lie inside, as in a ring or a
//! sheet (by winding number; openings count as open, so half of all directions must be covered).
std::vector<BulbFit> bulbs_in_middle(const Surface& surface);

//! \brief For the maker: which of the common bulbs keep #least_bulb_clearance in the middle; empty when it is outside.
std::string bulbs_text(const std::vector<BulbFit>& fits);

//! \brief Distance between the segment a-b and a triangle, mm; 0 when it passes through.
double segment_triangle_distance(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& triangle);

} // namespace rhombloom
