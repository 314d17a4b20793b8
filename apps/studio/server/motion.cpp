#include "apps/studio/server/motion.h"

namespace rhombloom::studio {

Expected<Eigen::Isometry3d> take_motion(ObjectReader& body)
{
    const Vec3 move = body.point("move_mm", Vec3::Zero());
    const Vec3 about = body.point("about_mm", Vec3::Zero());
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    if (const nlohmann::json* value = body.take("turn")) {
        if (!value->is_array() || value->size() != 4 ||
            !std::all_of(value->begin(), value->end(), [](const auto& x) { return x.is_number(); })) {
            return refuse("$.turn is " + describe(*value) + ": expected a quaternion of 4 numbers");
        }
        turn.coeffs() << (*value)[0].get<double>(), (*value)[1].get<double>(), (*value)[2].get<double>(),
            (*value)[3].get<double>();
        constexpr double least = 1e-3;
        constexpr double most = 1e3;
        if (!(turn.norm() > least && turn.norm() < most)) {
            return refuse("$.turn is no rotation: expected a quaternion of length 1");
        }
        turn.normalize();
    }
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.translate(move + about);
    motion.rotate(turn);
    motion.translate(-about);
    return motion;
}

Surface moved(Surface surface, const Eigen::Isometry3d& motion)
{
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, motion * surface.point(v));
    }
    return surface;
}

} // namespace rhombloom::studio
