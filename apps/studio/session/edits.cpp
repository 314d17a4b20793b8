#include "apps/studio/session/edits.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace rhombloom::studio {

namespace {

bool makes(const Operation& operation, const std::string& id)
{
    const auto* place = std::get_if<Place>(&operation);
    const auto* layout = std::get_if<Layout>(&operation);
    const auto* import = std::get_if<Import>(&operation);
    return (place != nullptr && place->id == id) || (layout != nullptr && layout->id == id) ||
           (import != nullptr && import->id == id);
}

Expected<void> check_part(const Design& design, const std::string& id)
{
    const auto& operations = design.operations;
    if (std::none_of(operations.begin(), operations.end(), [&](const auto& op) { return makes(op, id); })) {
        return refuse("there is no part \"" + id.substr(0, 60) + "\"");
    }
    for (const Operation& operation : operations) {
        const auto* merge = std::get_if<Merge>(&operation);
        if (merge != nullptr && (merge->with == id || merge->on == id)) {
            return refuse("\"" + id + "\" is merged: change its step in the history instead");
        }
    }
    return {};
}

//! Micrometres and microdegrees: what a person sets by hand stays readable in the file.
double tidy(double x)
{
    constexpr double millionth = 1e6;
    return std::round(x * millionth) / millionth + 0.0;
}

struct Mover
{
    const Eigen::Isometry3d& motion;

    void move(Reference& reference) const
    {
        if (reference.kind == Reference::Kind::Near) {
            reference.point = motion * reference.point;
        } else if (reference.kind == Reference::Kind::Toward) {
            reference.point = motion.linear() * reference.point;
        }
    }
    template <class Posed>
    void move_pose(Posed& op) const
    {
        op.position = (motion * op.position).unaryExpr(&tidy);
        op.rotation_deg = euler_deg(motion.linear() * rotation_matrix(op.rotation_deg));
    }
    void operator()(Place& op) const { move_pose(op); }
    void operator()(Layout& op) const { move_pose(op); }
    void operator()(Import& op) const
    {
        for (Vec3& p : op.positions) {
            p = motion * p;
        }
    }
    void operator()(Merge&) const {}
    void operator()(Extrude& op) const
    {
        move(op.apex);
        op.by = motion.linear() * op.by;
    }
    void operator()(Open& op) const
    {
        for (Reference& reference : op.elements) {
            move(reference);
        }
    }
    void operator()(Flip& op) const { move(op.element); }
};

struct Subject
{
    template <class Op>
    const std::string& operator()(const Op& op) const
    {
        if constexpr (requires { op.on; }) {
            return op.on;
        } else {
            return op.id;
        }
    }
};

} // namespace

const std::string& subject(const Operation& operation)
{
    return std::visit(Subject(), operation);
}

Eigen::Matrix3d rotation_matrix(const Vec3& euler_deg)
{
    return (Eigen::AngleAxisd(radians(euler_deg.z()), Vec3::UnitZ()) *
            Eigen::AngleAxisd(radians(euler_deg.y()), Vec3::UnitY()) *
            Eigen::AngleAxisd(radians(euler_deg.x()), Vec3::UnitX()))
        .toRotationMatrix();
}

Vec3 euler_deg(const Eigen::Matrix3d& R)
{
    const double y = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
    constexpr double upright = 1e-9; // the cosine below which x and z turn about the same axis
    if (std::abs(std::cos(y)) < upright) {
        return Vec3(0, degrees(y), degrees(std::atan2(-R(0, 1), R(1, 1)))).unaryExpr(&tidy);
    }
    return Vec3(degrees(std::atan2(R(2, 1), R(2, 2))), degrees(y), degrees(std::atan2(R(1, 0), R(0, 0))))
        .unaryExpr(&tidy);
}

Expected<Design> moved_part(const Design& design, const std::string& id, const Eigen::Isometry3d& motion)
{
    if (auto ok = check_part(design, id); !ok) {
        return tl::make_unexpected(ok.error());
    }
    Design result = design;
    for (Operation& operation : result.operations) {
        if (subject(operation) == id) {
            std::visit(Mover{motion}, operation);
        }
    }
    return result;
}

Expected<Design> without_part(const Design& design, const std::string& id)
{
    std::set<std::string> gone = {id};
    for (const Operation& operation : design.operations) {
        if (const auto* merge = std::get_if<Merge>(&operation); merge != nullptr && gone.contains(merge->on)) {
            gone.insert(merge->with);
        }
    }
    Design result = design;
    std::erase_if(result.operations, [&](const Operation& op) { return gone.contains(subject(op)); });
    if (result.operations.size() == design.operations.size()) {
        return refuse("there is no part \"" + id.substr(0, 60) + "\"");
    }
    return result;
}

} // namespace rhombloom::studio
