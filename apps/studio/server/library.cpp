#include "apps/studio/server/library.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/studio/server/answers.h"
#include "core/design/pose.h"
#include "core/model/base_shapes.h"
#include "core/text.h"
#include "exporters/bent_element.h"
#include "exporters/buildability.h"
#include "exporters/cut_sheet.h"
#include "exporters/thumbnail.h"

namespace rhombloom::studio {

using nlohmann::ordered_json;

namespace {

constexpr int thumbnail_pixels = 144;
constexpr std::size_t most_thumbnails = 200;
constexpr int sample = 60; // pieces nested to learn what one takes
constexpr std::size_t largest_pictured = 1500;

std::string key(const Element& element)
{
    return to_text(element.la) + " " + to_text(element.lb) + " " + to_text(element.alpha) + " " +
           to_text(element.thickness);
}

std::string query(const Request& request, const std::string& name)
{
    const auto found = request.query.find(name);
    return found == request.query.end() ? "" : found->second;
}

Expected<std::string> picture(const std::string& name, const Element& element)
{
    auto shape = base_shape(name, element);
    if (!shape) {
        return tl::make_unexpected(shape.error());
    }
    if (shape->surface.n_faces() > largest_pictured) {
        return refuse(name + " is too large for a thumbnail");
    }
    embed_in_place(shape->surface, element, {});
    PictureOptions options;
    options.width = thumbnail_pixels;
    options.height = thumbnail_pixels;
    options.background = Background::Transparent;
    return surface_picture_png(shape->surface, element, options);
}

ordered_json names_and_titles()
{
    ordered_json list = ordered_json::array();
    for (const Machine& machine : machines()) {
        list.push_back({{"name", machine.name}, {"title", machine.title}});
    }
    return list;
}

} // namespace

Reply Library::shapes(const Element& element)
{
    const std::scoped_lock lock(mutex_);
    std::string& text = shapes_[key(element)];
    if (text.empty()) {
        ordered_json list = ordered_json::array();
        for (const std::string& name : base_shape_names()) {
            if (const auto shape = base_shape(name, element)) {
                list.push_back({{"name", name},
                                {"summary", shape->summary},
                                {"elements", shape->surface.n_faces()},
                                {"open", shape->surface.is_boundary(shape->seed)}});
            }
        }
        text = list.dump();
    }
    return {200, "application/json", text};
}

Reply Library::thumbnail(const Request& request, const Element& element)
{
    const std::string name = query(request, "shape");
    const std::string id = key(element) + " " + name;
    {
        const std::scoped_lock lock(mutex_);
        if (const auto known = thumbnails_.find(id); known != thumbnails_.end()) {
            return {200, "image/png", known->second};
        }
    }
    const auto png = picture(name, element);
    if (!png) {
        return error_reply(png.error());
    }
    const std::scoped_lock lock(mutex_);
    if (thumbnails_.size() >= most_thumbnails) {
        thumbnails_.clear();
    }
    thumbnails_[id] = *png;
    return {200, "image/png", *png};
}

Reply Library::piece(const Element& element)
{
    const auto outline = element_outline(hook_parameters(element));
    if (!outline) {
        return error_reply(outline.error());
    }
    FlatSheetOptions options;
    options.tolerance = 0.004 * element.la;
    options.rim_step = 0.16 * element.la;
    options.along = 0.16 * element.la;
    options.across = 0.3 * element.la;
    const FlatSheet sheet = flat_sheet(*outline, options);
    const Eigen::Matrix2d to_unit = rhomboid(element).inverse();
    ordered_json points = ordered_json::array();
    for (const Vec2& p : sheet.points) {
        const Vec2 uv = to_unit * p;
        points.push_back(uv.x());
        points.push_back(uv.y());
    }
    ordered_json triangles = ordered_json::array();
    for (const auto& t : sheet.triangles) {
        triangles.insert(triangles.end(), {t[0], t[1], t[2]});
    }
    return json_reply({{"points", points},
                       {"rim", sheet.rim},
                       {"triangles", triangles},
                       {"la_mm", element.la},
                       {"lb_mm", element.lb},
                       {"alpha_deg", degrees(element.alpha)},
                       {"thickness_mm", element.thickness}});
}

Library::PerPiece Library::per_piece(const Element& element)
{
    const std::scoped_lock lock(mutex_);
    const std::string id = key(element);
    if (const auto known = per_piece_.find(id); known != per_piece_.end()) {
        return known->second;
    }
    PerPiece result;
    const auto piece = make_piece(element, std::nullopt, {});
    const auto cut = piece ? cut_drawings(piece->element, piece->parameters.hook, sample, {})
                           : Expected<CutDrawings>(tl::make_unexpected(piece.error()));
    if (cut) {
        const CutOptions options;
        const double area_of_one = std::abs(area(*element_outline(piece->parameters.hook)));
        result.sheets =
            area_of_one / std::max(1e-9, cut->report.utilisation * options.sheet_width * options.sheet_height);
        result.minutes = cut->report.minutes / sample;
        result.mass_g = cut->report.mass_g / sample;
    } else {
        result.error = cut.error().message;
    }
    return per_piece_[id] = result;
}

Reply Library::figures(const Request& request, const Element& element)
{
    constexpr int most = 1'000'000;
    const std::string text = query(request, "count");
    int count = 0;
    const auto end = std::from_chars(text.data(), text.data() + text.size(), count);
    if (end.ec != std::errc() || end.ptr != text.data() + text.size() || count < 0 || count > most) {
        return error_reply(422, "count is \"" + text.substr(0, 20) + "\": expected a number of elements");
    }
    const PerPiece each = per_piece(element);
    if (!each.error.empty()) {
        return error_reply(422, each.error);
    }
    return json_reply({{"count", count},
                       {"sheets", static_cast<int>(std::ceil(count * each.sheets - 1e-9))},
                       {"minutes", count * each.minutes},
                       {"mass_g", count * each.mass_g}});
}

Reply Library::choices() const
{
    ordered_json list = ordered_json::array();
    const auto all = materials();
    if (!all) {
        return error_reply(all.error());
    }
    for (const Material& material : *all) {
        list.push_back({{"name", material.name}, {"title", material.title}});
    }
    return json_reply({{"materials", list}, {"machines", names_and_titles()}});
}

} // namespace rhombloom::studio
