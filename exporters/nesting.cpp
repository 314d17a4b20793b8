// This work is based on Yu. Stoyan and A. Pankratov, "Regular packing of congruent polygons on the rectangular
// sheet", European Journal of Operational Research 113 (1999).
#include "exporters/nesting.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/text.h"
#include "core/units.h"
#include "exporters/nesting_layout.h"

namespace rhombloom {

namespace {

using namespace nesting;

//! Repeated points dropped, counter-clockwise.
Polygon cleaned(const std::vector<Vec2>& outline)
{
    Polygon polygon;
    for (const Vec2& p : outline) {
        if (polygon.empty() || p != polygon.back()) {
            polygon.push_back(p);
        }
    }
    while (polygon.size() > 1 && polygon.back() == polygon.front()) {
        polygon.pop_back();
    }
    if (polygon.size() >= 3 && signed_area(polygon) < 0) {
        std::reverse(polygon.begin(), polygon.end());
    }
    return polygon;
}

std::string size_text(double width, double height)
{
    return to_fixed(width, 3) + " x " + to_fixed(height, 3) + " mm";
}

Expected<void> check_length(const char* name, double value, double min, double max)
{
    if (!(value >= min && value <= max)) {
        return refuse(std::string(name) + " is " + to_text(value) + " mm; it must be between " + to_text(min) +
                      " and " + to_text(max) + " mm");
    }
    return {};
}

Expected<void> check_sheet(const char* name, double width, double height, double margin)
{
    for (const double size : {width, height}) {
        if (auto ok = check_length(name, size, 1, 1e5); !ok) {
            return ok;
        }
        if (2 * margin >= size) {
            return refuse(std::string("the margin of ") + to_text(margin) + " mm leaves nothing of a " + name + " of " +
                          size_text(width, height));
        }
    }
    return {};
}

Expected<void> check_options(const NestOptions& options)
{
    if (options.count < 1 || options.count > 100000) {
        return refuse("the count is " + std::to_string(options.count) + "; it must be between 1 and 100000");
    }
    if (auto ok = check_length("the spacing", options.spacing, 0, 1000); !ok) {
        return ok;
    }
    if (auto ok = check_length("the margin", options.margin, 0, 1e4); !ok) {
        return ok;
    }
    if (options.remnant) {
        if (auto ok = check_sheet("remnant", options.remnant->x(), options.remnant->y(), options.margin); !ok) {
            return ok;
        }
    }
    return check_sheet("sheet", options.sheet_width, options.sheet_height, options.margin);
}

Box bounds_of(const std::vector<Placement>& placements, const Polygon& hull)
{
    Box used;
    for (const Placement& placement : placements) {
        const Box box = extents(hull, {placement.angle, placement.mirrored});
        used.min = used.min.cwiseMin(box.min + placement.offset);
        used.max = used.max.cwiseMax(box.max + placement.offset);
    }
    return used;
}

double area(const Box& box)
{
    const Vec2 size = (box.max - box.min).cwiseMax(0.0);
    return size.x() * size.y();
}

//! The larger of the strips above and to the right of the copies.
Box offcut_of(const Sheet& sheet, double spacing)
{
    const Vec2 size(sheet.width, sheet.height);
    const Box above{Vec2(0, sheet.used.max.y() + spacing), size};
    const Box beside{Vec2(sheet.used.max.x() + spacing, 0), size};
    const Box larger = area(above) >= area(beside) ? above : beside;
    return area(larger) > 0 ? larger : Box{size, size};
}

Sheet sheet_of(std::vector<Placement> placements, double width, double height, const Polygon& hull,
               const NestOptions& options)
{
    Sheet sheet{width, height, false, std::move(placements), {}, {}};
    for (Placement& placement : sheet.placements) {
        placement.offset += Vec2::Constant(options.margin);
    }
    sheet.used = bounds_of(sheet.placements, hull);
    sheet.offcut = offcut_of(sheet, options.spacing);
    return sheet;
}

double utilisation_of(const std::vector<Sheet>& sheets, double piece_area)
{
    double pieces = 0, spent = 0;
    for (const Sheet& sheet : sheets) {
        pieces += piece_area * static_cast<double>(sheet.placements.size());
        spent += sheet.width * sheet.height - (&sheet == &sheets.back() ? area(sheet.offcut) : 0);
    }
    return pieces / spent;
}

Room room_of(double width, double height, double margin)
{
    return {width - 2 * margin, height - 2 * margin};
}

Expected<void> check_fits(const Piece& piece, const NestOptions& options)
{
    const Room room = room_of(options.sheet_width, options.sheet_height, options.margin);
    if (!single_copy(piece, room).empty()) {
        return {};
    }
    const Box box = box_of(piece.hull);
    const Vec2 size = box.max - box.min;
    // Callers add to the margin what their outline strays: a tenth of a millimetre is what the user gave.
    return refuse("the outline is " + size_text(size.x(), size.y()) +
                  " as drawn and fits in no allowed direction on a sheet of " +
                  size_text(options.sheet_width, options.sheet_height) + " with a margin of " +
                  to_fixed(options.margin, 1) + " mm; take a larger sheet, a smaller margin or a smaller outline" +
                  (options.grain == Grain::Any ? "" : ", or let the copies turn (grain any)"));
}

//! \return how many copies the offcut took
int fill_remnant(const Piece& piece, const NestOptions& options, Nesting& nesting)
{
    const Vec2 size = *options.remnant;
    const Room room = room_of(size.x(), size.y(), options.margin);
    const Layout full = densest_layout(piece, room, options.count, options.effort);
    if (full.empty()) {
        return 0;
    }
    const int taken = std::min(options.count, static_cast<int>(full.size()));
    Sheet sheet = sheet_of(packed_layout(piece, room, full, taken), size.x(), size.y(), piece.hull, options);
    sheet.remnant = true;
    nesting.sheets.push_back(std::move(sheet));
    return taken;
}

void fill_sheets(const Piece& piece, const NestOptions& options, int left, Nesting& nesting)
{
    const double width = options.sheet_width, height = options.sheet_height;
    const Room room = room_of(width, height, options.margin);
    const Layout full = densest_layout(piece, room, left, options.effort);
    nesting.per_sheet = static_cast<int>(full.size());
    for (; left > 0; left -= nesting.per_sheet) {
        Layout layout = packed_layout(piece, room, full, std::min(left, nesting.per_sheet));
        nesting.sheets.push_back(sheet_of(std::move(layout), width, height, piece.hull, options));
    }
}

//! Where the outline's own origin is for the search: at its middle when it was drawn away from the origin, as drawings
//! in world coordinates are; far from the origin the search would be slow and coarse.
Vec2 origin_for(const Polygon& polygon)
{
    const Box box = box_of(polygon);
    const bool around = (box.min.array() <= 0).all() && (box.max.array() >= 0).all();
    return around ? Vec2::Zero() : Vec2(0.5 * (box.min + box.max));
}

Polygon moved(Polygon polygon, const Vec2& by)
{
    for (Vec2& p : polygon) {
        p += by;
    }
    return polygon;
}

//! Placements of an outline that was moved by -\p origin become those of the outline as it was.
void give_origin_back(const Vec2& origin, Nesting& nesting)
{
    for (Sheet& sheet : nesting.sheets) {
        for (Placement& p : sheet.placements) {
            p.offset -= turn(p.angle) * (p.mirrored ? Vec2(-origin.x(), origin.y()) : origin);
        }
    }
}

} // namespace

Vec2 placed(const Vec2& p, const Placement& placement)
{
    return turn(placement.angle) * (placement.mirrored ? Vec2(-p.x(), p.y()) : p) + placement.offset;
}

Expected<Nesting> nest(const std::vector<Vec2>& outline, const NestOptions& options)
{
    const Polygon given = cleaned(outline);
    const Vec2 origin = given.empty() ? Vec2::Zero() : origin_for(given);
    const Polygon polygon = moved(given, -origin);
    if (auto ok = check_simple(given); !ok) {
        return tl::make_unexpected(ok.error());
    }
    if (auto ok = check_options(options); !ok) {
        return tl::make_unexpected(ok.error());
    }
    const Piece piece = piece_of(polygon, options);
    if (auto ok = check_fits(piece, options); !ok) {
        return tl::make_unexpected(ok.error());
    }
    Nesting nesting;
    int left = options.count;
    if (options.remnant) {
        left -= fill_remnant(piece, options, nesting);
    }
    fill_sheets(piece, options, left, nesting);
    nesting.utilisation = utilisation_of(nesting.sheets, signed_area(polygon));
    give_origin_back(origin, nesting);
    return nesting;
}

} // namespace rhombloom
