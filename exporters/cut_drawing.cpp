#include "exporters/cut_drawing.h"

#include <algorithm>
#include <cmath>

#include "exporters/cut_order.h"
#include "exporters/strokes.h"
#include "exporters/svg.h"

namespace rhombloom {

namespace {

constexpr double reference_inset = 1;  // mm, so that it does not lie on the sheet's border
constexpr double neighbour_reach = 10; // mm, pieces nearer than this warm each other

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

Path named(Path path, const std::string& id)
{
    path.id = id;
    return path;
}

void append(std::vector<Path>& paths, const std::vector<Path>& more, const std::string& id)
{
    for (std::size_t i = 0; i < more.size(); ++i) {
        paths.push_back(named(more[i], id + "-" + std::to_string(i + 1)));
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
    const char* id = "reference-square";
    for (const double size : sizes) {
        const double right = sheet.width - reference_inset - size;
        const double top = sheet.height - reference_inset - size;
        for (const Vec2& corner : {Vec2(right, top), Vec2(right, reference_inset), Vec2(reference_inset, top),
                                   Vec2(reference_inset, reference_inset)}) {
            const Path square = rectangle(corner, size, size);
            if (corner.minCoeff() > 0 && !touches(square, pieces)) {
                return named(square, id);
            }
        }
    }
    return named(rectangle(Vec2::Constant(reference_inset), sizes[2], sizes[2]), id);
}

//! Apart from each other, because cuts warm the film.
std::vector<std::size_t> order_of_cuts(const std::vector<LaidPiece>& pieces)
{
    std::vector<Vec2> starts;
    std::vector<Path> contours;
    for (const LaidPiece& piece : pieces) {
        starts.push_back(piece.outer.vertices.front().point);
        contours.push_back(piece.finished);
    }
    return cutting_order(starts, neighbours(contours, neighbour_reach), Vec2::Zero());
}

//! The shortest way round.
std::vector<std::size_t> order_of_marks(const std::vector<LaidPiece>& pieces)
{
    std::vector<Vec2> starts;
    for (const LaidPiece& piece : pieces) {
        const Path& first = piece.engraved.empty() ? piece.finished : piece.engraved.front();
        starts.push_back(first.vertices.front().point);
    }
    const Neighbours none(pieces.size(), std::vector<bool>(pieces.size(), false));
    return cutting_order(starts, none, Vec2::Zero());
}

struct LayerKind
{
    const char* name;
    LayerUse use;
    const char* purpose;
};

//! In the order in which they are done.
constexpr LayerKind layer_kinds[] = {
    {"ENGRAVE", LayerUse::Engrave, "engraves lines"},
    {"CUT_INNER", LayerUse::CutInner, "cuts slits"},
    {"CUT_OUTER", LayerUse::CutOuter, "cuts outlines"},
    {"SHEET", LayerUse::Sheet, "shows the sheet, not for the machine"},
    {"REFERENCE", LayerUse::Reference,
     "is a square of 50 mm (20 or 10 on a full sheet) to measure on the screen, not for the machine"},
};

bool has_layer(const CutOptions& options, LayerUse use)
{
    // K40 Whisperer would engrave the border: it has no colour to ignore.
    const bool annotation = use == LayerUse::Sheet || use == LayerUse::Reference;
    return !annotation || (options.annotations && options.colours != ColourPreset::K40);
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
    const double height = std::clamp(parameters.la / 16, std::min(3.0, parameters.la / 13), 8.0);
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

Blank::Blank(Path contour, const Kerf& kerf) : contour_(std::move(contour)), kerf_(kerf) {}

Expected<LaidPiece> Blank::laid(const Placement& placement)
{
    expects(!placement.mirrored, "Blank::laid: pieces are not mirrored");
    // An unequal kerf is an ellipse that does not turn with the piece.
    const double angle = kerf_.x == kerf_.y ? 0 : placement.angle;
    auto found = tool_paths_.find(angle);
    if (found == tool_paths_.end()) {
        auto tool = tool_path(placed(contour_, angle, Vec2::Zero()), kerf_);
        if (!tool) {
            return tl::make_unexpected(tool.error());
        }
        found = tool_paths_.emplace(angle, std::move(*tool)).first;
    }
    const double rest = placement.angle - angle;
    LaidPiece piece;
    piece.finished = placed(contour_, placement.angle, placement.offset);
    piece.outer = begun_on_longest_line(placed(found->second.contour, rest, placement.offset));
    piece.inner = rhombloom::laid(found->second.slits, {rest, false, placement.offset});
    return piece;
}

std::vector<Path> laid(const std::vector<Path>& paths, const Placement& placement)
{
    std::vector<Path> result;
    for (const Path& path : paths) {
        result.push_back(placed(path, placement.angle, placement.offset));
    }
    return result;
}

std::string layers_text(const CutOptions& options)
{
    std::string text;
    for (const LayerKind& kind : layer_kinds) {
        if (has_layer(options, kind.use)) {
            text += (text.empty() ? "" : ", ") + std::string(kind.name) + " " +
                    colour_text(cut_colour(options.colours, kind.use)) + " " + kind.purpose;
        }
    }
    return text;
}

Drawing cut_drawing(const std::vector<LaidPiece>& pieces, const std::vector<std::string>& ids, const SheetSize& sheet,
                    const CutOptions& options)
{
    Drawing drawing{sheet.width, sheet.height, {}, {}};
    for (const LayerKind& kind : layer_kinds) {
        if (has_layer(options, kind.use)) {
            drawing.layers.push_back({kind.name, kind.use, cut_colour(options.colours, kind.use), {}});
        }
    }
    for (const std::size_t i : order_of_marks(pieces)) {
        append(drawing.layers[0].paths, pieces[i].engraved, ids[i] + "-mark");
    }
    for (const std::size_t i : order_of_cuts(pieces)) {
        append(drawing.layers[1].paths, pieces[i].inner, ids[i] + "-slit");
        drawing.layers[2].paths.push_back(named(pieces[i].outer, ids[i]));
    }
    if (has_layer(options, LayerUse::Sheet)) {
        drawing.layers[3].paths = {named(rectangle(Vec2::Zero(), sheet.width, sheet.height), "sheet")};
        drawing.layers[4].paths = {reference_square(pieces, sheet)};
    }
    return drawing;
}

} // namespace rhombloom
