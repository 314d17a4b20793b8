#include "core/design/operation_file.h"

namespace rhombloom {

using nlohmann::ordered_json;

namespace {

ordered_json write_point(const Vec3& p)
{
    return ordered_json::array({p.x(), p.y(), p.z()});
}

ordered_json write_reference(const Reference& reference, const char* number_key)
{
    switch (reference.kind) {
    case Reference::Kind::Near:
        return {{"near_mm", write_point(reference.point)}};
    case Reference::Kind::Toward:
        return {{"toward", write_point(reference.point)}};
    default:
        return {{number_key, reference.number}};
    }
}

ordered_json write(const Place& place)
{
    return {{"op", "place"},
            {"id", place.id},
            {"shape", place.shape},
            {"position_mm", write_point(place.position)},
            {"rotation_deg", write_point(place.rotation_deg)}};
}

ordered_json write(const Merge& merge)
{
    ordered_json out = {{"op", "merge"}, {"on", merge.on}, {"with", merge.with}, {"candidate", merge.candidate}};
    if (merge.symmetric) {
        out["symmetric"] = true;
    }
    return out;
}

ordered_json write(const Extrude& extrude)
{
    ordered_json out = {{"op", "extrude"}};
    if (!extrude.id.empty()) {
        out["id"] = extrude.id;
    }
    out["on"] = extrude.on;
    out["apex"] = write_reference(extrude.apex, "vertex");
    out["brush"] = extrude.brush;
    out["by_mm"] = write_point(extrude.by);
    if (extrude.candidate != 0) {
        out["candidate"] = extrude.candidate;
    }
    if (extrude.symmetric) {
        out["symmetric"] = true;
    }
    return out;
}

ordered_json write(const Open& open)
{
    ordered_json out = {{"op", "open"}, {"on", open.on}, {"elements", ordered_json::array()}};
    for (const Reference& reference : open.elements) {
        out["elements"].push_back(write_reference(reference, "element"));
    }
    if (!open.purpose.empty()) {
        out["purpose"] = open.purpose;
    }
    if (open.symmetric) {
        out["symmetric"] = true;
    }
    return out;
}

ordered_json write(const Flip& flip)
{
    ordered_json out = {{"op", "flip"}, {"on", flip.on}, {"element", write_reference(flip.element, "element")}};
    if (flip.symmetric) {
        out["symmetric"] = true;
    }
    return out;
}

ordered_json write(const Layout& layout)
{
    ordered_json out = {{"op", "layout"}, {"id", layout.id}, {"position_mm", write_point(layout.position)}};
    if (layout.rotation_deg != Vec3::Zero()) {
        out["rotation_deg"] = write_point(layout.rotation_deg);
    }
    out["elements"] = ordered_json::array();
    for (const LayoutElement& drawn : layout.elements) {
        out["elements"].push_back({{"x_mm", drawn.at.x()},
                                   {"y_mm", drawn.at.y()},
                                   {"rotation_deg", drawn.rotation_deg},
                                   {"facing", drawn.facing == Facing::Front ? "front" : "back"}});
    }
    out["joins"] = ordered_json::array();
    for (const LayoutJoin& join : layout.joins) {
        out["joins"].push_back(
            {{"element", join.element}, {"side", join.side}, {"to", join.to}, {"to_side", join.to_side}});
    }
    return out;
}

ordered_json write(const Import& import)
{
    ordered_json out = {{"op", "import"}, {"id", import.id}};
    if (!import.target.empty()) {
        out["target"] = import.target;
        out["target_sha256"] = import.target_sha256;
    }
    if (const auto& d = import.distance) {
        out["distance_mm"] = {{"to_target_rms", d->to_target_rms},
                              {"to_target_max", d->to_target_max},
                              {"from_target_rms", d->from_target_rms},
                              {"from_target_max", d->from_target_max}};
    }
    out["points_mm"] = ordered_json::array();
    for (const Vec3& p : import.positions) {
        out["points_mm"].push_back(write_point(p));
    }
    out["elements"] = import.quads;
    out["flipped"] = import.flipped;
    return out;
}

} // namespace

ordered_json write_operation(const Operation& operation)
{
    return std::visit([](const auto& op) { return write(op); }, operation);
}

ordered_json write_symmetry(const Symmetry& symmetry)
{
    ordered_json out;
    out[symmetry.kind == Symmetry::Kind::Mirror ? "mirror" : "axis"] = write_point(symmetry.direction);
    out["through_mm"] = write_point(symmetry.through);
    if (symmetry.kind == Symmetry::Kind::Axis) {
        out["fold"] = symmetry.fold;
    }
    return out;
}

} // namespace rhombloom
