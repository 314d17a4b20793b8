#include "exporters/figure_hooks.h"

#include <algorithm>
#include <cmath>

#include "exporters/outline.h"

namespace rhombloom {

namespace {

//! Corner k of the piece is this corner of the quad (v0 is acute and a long side leaves it, see outline.h).
std::array<int, 4> corners_of_piece(const Surface& surface, Face f)
{
    const Quad q = quad(surface, f);
    const bool front = surface.data(f).facing == Facing::Front;
    const Side first = front ? Side::Long : Side::Short; // the side of the vertices at acute corners
    const int start = surface.data(Vertex(q[0])).side == first ? 0 : 1;
    std::array<int, 4> corners{};
    for (int k = 0; k < 4; ++k) {
        corners[k] = q[front ? (start + k) % 4 : (start + 4 - k) % 4];
    }
    return corners;
}

Polygon node_polygon(const FigureScene& scene, Face f)
{
    Polygon nodes;
    for (const int v : corners_of_piece(*scene.surface, f)) {
        nodes.push_back(project(scene.camera, scene.surface->point(Vertex(v))));
    }
    return nodes;
}

Vec2 between(const Polygon& nodes, const Vec2& uv)
{
    const double u = uv.x();
    const double v = uv.y();
    return (1 - u) * ((1 - v) * nodes[0] + v * nodes[3]) + u * ((1 - v) * nodes[1] + v * nodes[2]);
}

Polygon mapped(const Polygon& nodes, const std::vector<Vec2>& uv)
{
    Polygon result;
    for (const Vec2& p : uv) {
        result.push_back((8 * between(nodes, p)).array().round() / 8); // a detail is good to 0.04 mm
    }
    return result;
}

Line contour_line(Paint paint)
{
    return {paint == Paint::Next ? 0.7 : 0.45, paint == Paint::Next ? 0x000000U : colour::line, 0};
}

//! Does another of the pieces lie beyond this side of the piece?
bool is_joined(const Surface& surface, Face f, int side, const std::vector<DrawnPiece>& pieces)
{
    const std::array<int, 4> corners = corners_of_piece(surface, f);
    const int a = corners[side];
    const int b = corners[(side + 1) % 4];
    return std::any_of(pieces.begin(), pieces.end(), [&](const DrawnPiece& piece) {
        const Quad q = quad(surface, piece.face);
        return piece.face != f && std::count(q.begin(), q.end(), a) > 0 && std::count(q.begin(), q.end(), b) > 0;
    });
}

} // namespace

namespace {

//! How far a point lies beyond a side of the piece; positive outside.
double beyond(const Vec2& uv, int side)
{
    switch (side) {
    case 0:
        return -uv.y();
    case 1:
        return uv.x() - 1;
    case 2:
        return uv.y() - 1;
    default:
        return -uv.x();
    }
}

//! Does the point belong to this side, and not to a neighbouring one's hook?
bool along(const Vec2& uv, int side)
{
    const double t = side % 2 == 0 ? uv.x() : uv.y();
    return t > 0 && t < 1;
}

//! The parts of the outline beyond a side, each from where it crosses the side to where it comes back.
std::vector<std::vector<Vec2>> flaps_of(const std::vector<Vec2>& outline, int side)
{
    const std::size_t n = outline.size();
    const auto out = [&](std::size_t i) { return beyond(outline[i % n], side) > 1e-9 && along(outline[i % n], side); };
    const auto crossing = [&](const Vec2& a, const Vec2& b) -> Vec2 {
        const double da = beyond(a, side);
        const double db = beyond(b, side);
        return da == db ? a : Vec2(a + (b - a) * std::clamp(da / (da - db), 0.0, 1.0));
    };
    std::vector<std::vector<Vec2>> flaps;
    for (std::size_t i = 0; i < n; ++i) {
        if (!out(i) || out(i + n - 1)) {
            continue;
        }
        std::vector<Vec2> flap = {crossing(outline[(i + n - 1) % n], outline[i])};
        std::size_t k = i;
        for (; out(k) && k < i + n; ++k) {
            flap.push_back(outline[k % n]);
        }
        flap.push_back(crossing(outline[k % n], outline[(k - 1) % n]));
        flaps.push_back(std::move(flap));
    }
    return flaps;
}

} // namespace

PieceContour piece_contour(const Element& element)
{
    const auto outline = element_outline(hook_parameters(element));
    if (!outline) {
        return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}};
    }
    const double c = std::cos(element.alpha);
    const double s = std::sin(element.alpha);
    PieceContour contour;
    for (const Vec2& p : flatten(*outline, 0.004 * element.la)) {
        const double v = p.y() / (element.la * s);
        contour.outline.emplace_back((p.x() - v * element.la * c) / element.lb, v);
    }
    for (int side = 0; side < 4; ++side) {
        contour.flaps[side] = flaps_of(contour.outline, side);
    }
    return contour;
}

Polygon piece_on_paper(const FigureScene& scene, Face f, const PieceContour& contour)
{
    return mapped(node_polygon(scene, f), contour.outline);
}

void draw_piece(PdfCanvas& canvas, const FigureScene& scene, const DrawnPiece& piece, const PieceContour& contour)
{
    canvas.fill_and_outline(piece_on_paper(scene, piece.face, contour), element_tint(scene, piece.face, piece.paint),
                            contour_line(piece.paint));
    draw_flip_dots(canvas, scene, piece.face, piece.paint);
}

void draw_flaps(PdfCanvas& canvas, const FigureScene& scene, const DrawnPiece& piece, const PieceContour& contour,
                int side, int count)
{
    const Polygon nodes = node_polygon(scene, piece.face);
    for (const auto& flap : contour.flaps[side]) {
        if (count-- > 0) {
            canvas.fill_and_stroke(mapped(nodes, flap), element_tint(scene, piece.face, piece.paint),
                                   contour_line(piece.paint));
        }
    }
}

void draw_pieces(PdfCanvas& canvas, const FigureScene& scene, const std::vector<DrawnPiece>& pieces,
                 const PieceContour& contour)
{
    for (const DrawnPiece& piece : pieces) {
        if (piece.hooks) {
            draw_piece(canvas, scene, piece, contour);
        } else {
            draw_element(canvas, scene, piece.face, piece.paint);
        }
    }
    for (const DrawnPiece& piece : pieces) {
        for (int side = 0; side < 4 && piece.hooks; ++side) {
            if (is_joined(*scene.surface, piece.face, side, pieces)) {
                draw_flaps(canvas, scene, piece, contour, side);
            }
        }
    }
}

std::vector<Face> faces_round(const Surface& surface, Face f)
{
    std::vector<Face> result;
    for (const Vertex v : surface.fv_range(f)) {
        for (const Face g : surface.vf_range(v)) {
            if (g != f && std::find(result.begin(), result.end(), g) == result.end()) {
                result.push_back(g);
            }
        }
    }
    return result;
}

} // namespace rhombloom
