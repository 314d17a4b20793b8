#include <algorithm>
#include <map>

#include "core/design/json_reader.h"
#include "core/design/operation_file.h"

namespace rhombloom {

using nlohmann::json;

namespace {

constexpr double farthest = 1e6;            // mm, a kilometre
constexpr std::size_t longest = 1000;       // entries of a list of elements or joins
constexpr std::size_t most_points = 200000; // of an imported network

template <class T>
Expected<Operation> finished(ObjectReader& reader, T operation)
{
    if (auto ok = reader.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return Operation(std::move(operation));
}

Expected<Reference> read_reference(const json& value, const std::string& path, const std::string& number_key)
{
    Reference reference;
    ObjectReader reader(value, path);
    const int given = reader.has(number_key) + reader.has("near_mm") + reader.has("toward");
    if (value.is_object() && given != 1) {
        return refuse(path + " needs exactly one of " + number_key + ", near_mm and toward");
    }
    reference.number = reader.integer(number_key, 0, 0, 100000000);
    if (reader.has("near_mm")) {
        reference.kind = Reference::Kind::Near;
        reference.point = reader.point("near_mm", Vec3::Zero());
    }
    if (reader.has("toward")) {
        reference.kind = Reference::Kind::Toward;
        reference.point = reader.point("toward", Vec3::UnitZ());
        if (reference.point.norm() == 0) {
            reader.fail("toward", "is [0, 0, 0]: expected a direction");
        }
    }
    if (auto ok = reader.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return reference;
}

Reference take_reference(ObjectReader& reader, const std::string& key, const std::string& number_key)
{
    reader.require(key);
    const json* value = reader.take(key);
    if (value == nullptr) {
        return {};
    }
    auto reference = read_reference(*value, reader.path(key), number_key);
    if (!reference) {
        reader.fail(reference.error());
        return {};
    }
    return *reference;
}

//! Every entry of the list at \p key, read by \p read(entry, path).
template <class T, class Read>
std::vector<T> take_list(ObjectReader& reader, const std::string& key, const Read& read, std::size_t most = longest)
{
    std::vector<T> result;
    const json* value = reader.take(key);
    if (value == nullptr) {
        return result;
    }
    if (!value->is_array() || value->size() > most) {
        reader.fail(key, "is " + describe(*value) + ": expected a list of at most " + std::to_string(most));
        return result;
    }
    for (std::size_t i = 0; i < value->size(); ++i) {
        auto entry = read((*value)[i], reader.path(key) + "[" + std::to_string(i) + "]");
        if (!entry) {
            reader.fail(entry.error());
            return {};
        }
        result.push_back(*entry);
    }
    return result;
}

Expected<Operation> read_place(ObjectReader& reader)
{
    Place place;
    reader.require("shape");
    place.id = reader.text("id", "body");
    place.shape = reader.text("shape", "");
    place.position = reader.point("position_mm", place.position);
    place.rotation_deg = reader.point("rotation_deg", place.rotation_deg);
    return finished(reader, std::move(place));
}

Expected<Operation> read_merge(ObjectReader& reader)
{
    Merge merge;
    reader.require("with");
    merge.on = reader.text("on", "body");
    merge.with = reader.text("with", "");
    merge.candidate = reader.integer("candidate", 0, 0, 1000);
    merge.symmetric = reader.flag("symmetric", false);
    return finished(reader, std::move(merge));
}

Expected<Operation> read_extrude(ObjectReader& reader)
{
    Extrude extrude;
    reader.require("brush");
    reader.require("by_mm");
    extrude.id = reader.text("id", "");
    extrude.on = reader.text("on", "body");
    extrude.apex = take_reference(reader, "apex", "vertex");
    extrude.brush = reader.text("brush", "");
    extrude.by = reader.point("by_mm", extrude.by);
    extrude.candidate = reader.integer("candidate", 0, 0, 1000);
    extrude.symmetric = reader.flag("symmetric", false);
    return finished(reader, std::move(extrude));
}

Expected<Reference> read_element_reference(const json& value, const std::string& path)
{
    return read_reference(value, path, "element");
}

Expected<Operation> read_open(ObjectReader& reader)
{
    Open open;
    reader.require("elements");
    open.on = reader.text("on", "body");
    open.elements = take_list<Reference>(reader, "elements", read_element_reference);
    open.purpose = reader.text("purpose", "");
    open.symmetric = reader.flag("symmetric", false);
    if (open.elements.empty()) {
        reader.fail("elements", "is empty: expected at least one element to take out");
    }
    return finished(reader, std::move(open));
}

Expected<Operation> read_flip(ObjectReader& reader)
{
    Flip flip;
    flip.on = reader.text("on", "body");
    flip.element = take_reference(reader, "element", "element");
    flip.symmetric = reader.flag("symmetric", false);
    return finished(reader, std::move(flip));
}

Expected<LayoutElement> read_layout_element(const json& value, const std::string& path)
{
    LayoutElement drawn;
    ObjectReader reader(value, path);
    drawn.at = {reader.number("x_mm", 0, -farthest, farthest), reader.number("y_mm", 0, -farthest, farthest)};
    drawn.rotation_deg = reader.number("rotation_deg", 0, -3600, 3600);
    const std::string facing = reader.text("facing", "front");
    if (facing != "front" && facing != "back") {
        reader.fail("facing", "is \"" + facing.substr(0, 60) + "\": expected front or back");
    }
    drawn.facing = facing == "back" ? Facing::Back : Facing::Front;
    if (auto ok = reader.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return drawn;
}

Expected<LayoutJoin> read_layout_join(const json& value, const std::string& path)
{
    LayoutJoin join;
    ObjectReader reader(value, path);
    for (const char* key : {"element", "side", "to", "to_side"}) {
        reader.require(key);
    }
    join.element = reader.integer("element", 0, 0, static_cast<int>(longest));
    join.side = reader.integer("side", 0, 0, 3);
    join.to = reader.integer("to", 0, 0, static_cast<int>(longest));
    join.to_side = reader.integer("to_side", 0, 0, 3);
    if (auto ok = reader.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return join;
}

Expected<Operation> read_layout(ObjectReader& reader)
{
    Layout layout;
    reader.require("elements");
    layout.id = reader.text("id", "body");
    layout.elements = take_list<LayoutElement>(reader, "elements", read_layout_element);
    layout.joins = take_list<LayoutJoin>(reader, "joins", read_layout_join);
    layout.position = reader.point("position_mm", layout.position);
    layout.rotation_deg = reader.point("rotation_deg", layout.rotation_deg);
    return finished(reader, std::move(layout));
}

Expected<Vec3> read_import_point(const json& value, const std::string& path)
{
    // A list has no keys: wrap it, so that points are read in one way everywhere.
    const json wrapped = {{"point", value}};
    ObjectReader reader(wrapped, path);
    const Vec3 point = reader.point("point", Vec3::Zero());
    if (auto ok = reader.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return point;
}

Expected<int> read_number_below(const json& value, std::size_t limit, const std::string& path)
{
    if (!value.is_number_integer() || value < 0 || value >= limit) {
        return refuse(path + " is " + describe(value) + ": expected a whole number from 0 to " +
                      std::to_string(limit - 1));
    }
    return value.get<int>();
}

Expected<Quad> read_quad(const json& value, std::size_t points, const std::string& path)
{
    if (!value.is_array() || value.size() != 4) {
        return refuse(path + " is " + describe(value) + ": expected the numbers of four points");
    }
    Quad quad{};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto number = read_number_below(value[k], points, path + "[" + std::to_string(k) + "]");
        if (!number) {
            return tl::make_unexpected(number.error());
        }
        quad[k] = *number;
    }
    return quad;
}

std::optional<ImportDistance> take_distance(ObjectReader& reader)
{
    constexpr double absurd = 1e9;
    const json* value = reader.take("distance_mm");
    if (value == nullptr) {
        return std::nullopt;
    }
    if (!value->is_object()) {
        reader.fail("distance_mm", "is " + describe(*value) + ": expected an object");
        return std::nullopt;
    }
    ObjectReader inner(*value, reader.path("distance_mm"));
    ImportDistance distance;
    distance.to_target_rms = inner.number("to_target_rms", 0, 0, absurd);
    distance.to_target_max = inner.number("to_target_max", 0, 0, absurd);
    distance.from_target_rms = inner.number("from_target_rms", 0, 0, absurd);
    distance.from_target_max = inner.number("from_target_max", 0, 0, absurd);
    if (auto ok = inner.finish(); !ok) {
        reader.fail(ok.error());
    }
    return distance;
}

Expected<Operation> read_import(ObjectReader& reader)
{
    Import import;
    reader.require("points_mm");
    reader.require("elements");
    import.id = reader.text("id", "body");
    import.target = reader.text("target", "");
    import.target_sha256 = reader.text("target_sha256", "");
    import.distance = take_distance(reader);
    import.positions = take_list<Vec3>(reader, "points_mm", read_import_point, most_points);
    const std::size_t points = import.positions.size();
    const auto quad = [points](const json& value, const std::string& path) { return read_quad(value, points, path); };
    import.quads = take_list<Quad>(reader, "elements", quad, most_points);
    const std::size_t quads = import.quads.size();
    const auto number = [quads](const json& value, const std::string& path) {
        return read_number_below(value, quads, path);
    };
    import.flipped = take_list<int>(reader, "flipped", number, most_points);
    if (import.quads.empty()) {
        reader.fail("elements", "is empty: expected at least one element");
    }
    return finished(reader, std::move(import));
}

Vec3 take_direction(ObjectReader& reader, const std::string& key)
{
    const Vec3 direction = reader.point(key, Vec3::UnitX());
    if (direction.norm() == 0) {
        reader.fail(key, "is [0, 0, 0]: expected a direction");
    }
    return direction;
}

} // namespace

Expected<Operation> read_operation(const json& value, const std::string& path)
{
    static const std::map<std::string, Expected<Operation> (*)(ObjectReader&)> readers = {
        {"place", read_place}, {"merge", read_merge},   {"extrude", read_extrude}, {"open", read_open},
        {"flip", read_flip},   {"layout", read_layout}, {"import", read_import}};
    ObjectReader reader(value, path);
    reader.require("op");
    const std::string op = reader.text("op", "place");
    if (const auto known = readers.find(op); known != readers.end()) {
        return known->second(reader);
    }
    reader.fail("op", "is \"" + op.substr(0, 60) + "\": expected place, merge, extrude, open, flip, layout or import");
    return tl::make_unexpected(reader.finish().error());
}

Expected<Symmetry> read_symmetry(const json& value, const std::string& path)
{
    Symmetry symmetry;
    ObjectReader reader(value, path);
    if (value.is_object() && reader.has("mirror") == reader.has("axis")) {
        return refuse(path + " needs exactly one of mirror and axis");
    }
    symmetry.kind = reader.has("mirror") ? Symmetry::Kind::Mirror : Symmetry::Kind::Axis;
    symmetry.direction = take_direction(reader, reader.has("mirror") ? "mirror" : "axis");
    symmetry.through = reader.point("through_mm", symmetry.through);
    if (symmetry.kind == Symmetry::Kind::Axis) {
        reader.require("fold");
        symmetry.fold = reader.integer("fold", 2, 2, 100);
    }
    if (auto ok = reader.finish(); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return symmetry;
}

} // namespace rhombloom
