#include "exporters/cut_drawing.h"

#include <algorithm>
#include <cmath>

#include "exporters/cut_order.h"
#include "exporters/kerf.h"
#include "exporters/strokes.h"

namespace rhombloom {

namespace {

constexpr double reference_inset = 1;  // mm, so that it does not lie on the sheet's border
constexpr double neighbour_reach = 10; // mm, pieces nearer than this warm each other

Path laid(const Path& path, const Placement& placement)
{
    return placed(placement.mirrored ? mirrored(path) : path, placement.angle, placement.offset);
}

std::vector<Path> laid(const std::vector<Path>& paths, const Placement& placement)
{
    std::vector<Path> result;
    for (const Path& path : paths) {
        result.push_back(laid(path, placement));
    }
    return result;
}

Path line(const Vec2& from, const Vec2& to)
{
    return {{{from, 0}, {to, 0}}, false};
}

Path rectangle(const Vec2& corner, double width, double height)
{
    const Vec2 x(width, 0);
    const Vec2 y(0, height);
    return {{{corner, 0}, {corner + x, 0}, {corner + x + y, 0}, {corner + y, 0}}, true};
}

void append(std::vector<Path>& paths, const std::vector<Path>& more, const std::string& id)
{
    for (std::size_t i = 0; i < more.size(); ++i) {
        paths.push_back(more[i]);
        paths.back().id = id + "-" + std::to_string(i + 1);
    }
}

//! Points along the square every millimetre: near enough to notice everything that crosses it.
std::vector<Vec2> around(const Path& square)
{
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 from = square.vertices[i].point;
        const Vec2 along = square.vertices[(i + 1) % 4].point - from;
        const int steps = static_cast<int>(std::ceil(along.norm()));
        for (int k = 0; k < steps; ++k) {
            points.push_back(from + along * (static_cast<double>(k) / steps));
        }
    }
    return points;
}

bool inside(const Vec2& p, const std::vector<Vec2>& polygon)
{
    bool odd = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2& a = polygon[i];
        const Vec2& b = polygon[(i + 1) % polygon.size()];
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) {
            odd = !odd;
        }
    }
    return odd;
}

bool touches(const Path& square, const std::vector<LaidPiece>& pieces)
{
    const std::vector<Vec2> points = around(square);
    return std::any_of(pieces.begin(), pieces.end(), [&](const LaidPiece& piece) {
        const std::vector<Vec2> polygon = flatten(piece.finished, 0.1);
        return gap(points, polygon) < 1 || inside(points.front(), polygon);
    });
}

//! As large as fits into a corner of the sheet without touching a piece. A square that fits nowhere lies in the lower
//! left corner all the same: it is never cut.
Path reference_square(const std::vector<LaidPiece>& pieces, const SheetSize& sheet)
{
    constexpr double sizes[] = {50, 20, 10}; // mm
    for (const double size : sizes) {
        const double right = sheet.width - reference_inset - size;
        const double top = sheet.height - reference_inset - size;
        for (const Vec2& corner : {Vec2(right, top), Vec2(right, reference_inset), Vec2(reference_inset, top),
                                   Vec2(reference_inset, reference_inset)}) {
            const Path square = rectangle(corner, size, size);
            if (corner.minCoeff() > 0 && !touches(square, pieces)) {
                return square;
            }
        }
    }
    return rectangle(Vec2::Constant(reference_inset), sizes[2], sizes[2]);
}

std::vector<std::size_t> order_of(const std::vector<LaidPiece>& pieces)
{
    std::vector<Vec2> starts;
    std::vector<Path> contours;
    for (const LaidPiece& piece : pieces) {
        starts.push_back(piece.outer.vertices.front().point);
        contours.push_back(piece.finished);
    }
    return cutting_order(starts, neighbours(contours, neighbour_reach), Vec2::Zero());
}

void add_annotations(Drawing& drawing, const std::vector<LaidPiece>& pieces, ColourPreset colours)
{
    const SheetSize sheet = {drawing.width, drawing.height};
    Path border = rectangle(Vec2::Zero(), sheet.width, sheet.height);
    border.id = "sheet";
    Path square = reference_square(pieces, sheet);
    square.id = "reference-square";
    drawing.layers.push_back({"SHEET", LayerUse::Sheet, cut_colour(colours, LayerUse::Sheet), {border}});
    drawing.layers.push_back({"REFERENCE", LayerUse::Reference, cut_colour(colours, LayerUse::Reference), {square}});
}

} // namespace

Path begun_on_longest_line(const Path& contour)
{
    const std::size_t n = contour.vertices.size();
    std::size_t longest = n - 1;
    double most = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double size = (contour.vertices[(i + 1) % n].point - contour.vertices[i].point).norm();
        if (contour.vertices[i].bulge == 0 && size > most + 1e-9) {
            most = size;
            longest = i;
        }
    }
    Path result = contour;
    std::rotate(result.vertices.begin(), result.vertices.begin() + static_cast<long>((longest + 1) % n),
                result.vertices.end());
    return result;
}

Vec2 piece_centre(const HookParameters& parameters)
{
    return Vec2(parameters.lb + parameters.la * std::cos(parameters.alpha),
                parameters.la * std::sin(parameters.alpha)) /
           2;
}

std::vector<Path> front_marks(const HookParameters& parameters, const std::string& label)
{
    const double height = std::clamp(parameters.la / 16, 3.0, 8.0);
    const Vec2 centre = piece_centre(parameters);
    std::vector<Path> marks;
    const Vec2 base = centre + Vec2(-strokes_width(label, height) / 2, 0.25 * height);
    for (const Path& stroke : strokes(label, height, SixNine::Underlined)) {
        marks.push_back(placed(stroke, 0, base));
    }
    const Vec2 tip = centre + Vec2(1.25 * height, -0.8 * height);
    marks.push_back(line(tip - Vec2(2.5 * height, 0), tip));
    const Vec2 barb(-0.45 * height, 0.3 * height);
    marks.push_back({{{tip + barb, 0}, {tip, 0}, {tip + Vec2(barb.x(), -barb.y()), 0}}, false});
    return marks;
}

Expected<LaidPiece> laid_piece(const Path& outline, const std::vector<Path>& marks, const Placement& placement,
                               const CutOptions& options)
{
    LaidPiece piece;
    piece.finished = laid(outline, placement);
    piece.engraved = laid(marks, placement);
    if (options.kerf_x == 0 && options.kerf_y == 0) {
        piece.outer = begun_on_longest_line(piece.finished);
        return piece;
    }
    return refuse("the kerf cannot be compensated yet: give 0 and let the cutting program do it");
}

Drawing cut_drawing(const std::vector<LaidPiece>& pieces, const std::vector<std::string>& ids, const SheetSize& sheet,
                    const CutOptions& options)
{
    const auto layer = [&](const char* name, LayerUse use) {
        return Layer{name, use, cut_colour(options.colours, use), {}};
    };
    Drawing drawing{sheet.width, sheet.height, {}, {}};
    drawing.layers = {layer("ENGRAVE", LayerUse::Engrave), layer("CUT_INNER", LayerUse::CutInner),
                      layer("CUT_OUTER", LayerUse::CutOuter)};
    for (const std::size_t i : order_of(pieces)) {
        append(drawing.layers[0].paths, pieces[i].engraved, ids[i] + "-mark");
        append(drawing.layers[1].paths, pieces[i].inner, ids[i] + "-slit");
        drawing.layers[2].paths.push_back(pieces[i].outer);
        drawing.layers[2].paths.back().id = ids[i];
    }
    // K40 Whisperer would engrave the border: it has no colour to ignore.
    if (options.annotations && options.colours != ColourPreset::K40) {
        add_annotations(drawing, pieces, options.colours);
    }
    return drawing;
}

} // namespace rhombloom
