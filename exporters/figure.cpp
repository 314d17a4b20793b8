#include "exporters/figure.h"

#include <algorithm>
#include <cmath>

namespace rhombloom {

namespace {

Vec2 at(const Polygon& p, double u, double v)
{
    return (1 - u) * ((1 - v) * p[0] + v * p[3]) + u * ((1 - v) * p[1] + v * p[2]);
}

Vec2 middle(const Polygon& p)
{
    return (p[0] + p[1] + p[2] + p[3]) / 4;
}

unsigned mixed(unsigned a, unsigned b, double share)
{
    unsigned result = 0;
    for (const int shift : {16, 8, 0}) {
        const double x = (a >> shift) & 0xFFU;
        const double y = (b >> shift) & 0xFFU;
        result |= static_cast<unsigned>(std::lround(x + share * (y - x))) << shift;
    }
    return result;
}

//! Light from the upper left, behind the reader's shoulder; few steps, so that colours repeat in the file.
double shade(const FigureScene& scene, const Vec3& normal)
{
    const Viewpoint& eye = scene.camera.view;
    const Vec3 light = (0.5 * eye.toward + 0.6 * eye.up - 0.6 * eye.right).normalized();
    return std::round(10 * std::clamp(0.3 + 0.7 * normal.dot(light), 0.0, 1.0)) / 10;
}

Line edge_line(Paint paint)
{
    switch (paint) {
    case Paint::Ghost:
        return {0.35, colour::ghost_line, 0};
    case Paint::Faint:
        return {0.35, colour::faint_line, 0};
    case Paint::Chapter:
        return {0.8, colour::line, 0};
    case Paint::Next:
        return {0.9, 0x000000, 0};
    case Paint::Removed:
        return {1.4, 0x000000, 3};
    default:
        return {0.5, colour::line, 0};
    }
}

//! Dots on three lines across the element, evenly spaced on the paper.
void draw_dots(PdfCanvas& canvas, const Polygon& p, unsigned rgb)
{
    const double size = std::sqrt(polygon_area(p));
    const double spacing = std::clamp(std::round(0.32 * size) / 2, 2.0, 7.0);
    std::vector<std::pair<Vec2, Vec2>> rows;
    for (const double v : {0.25, 0.5, 0.75}) {
        const Vec2 a = at(p, 0.1, v);
        const Vec2 b = at(p, 0.9, v);
        const double length = (b - a).norm();
        const int gaps = static_cast<int>(length / spacing);
        if (gaps < 1) {
            continue;
        }
        const Vec2 half = (b - a) / length * (gaps * spacing / 2 + 0.01);
        rows.emplace_back((a + b) / 2 - half, (a + b) / 2 + half);
    }
    canvas.dots(rows, std::clamp(0.38 * spacing, 0.9, 2.2), spacing, rgb);
}

bool flipped(const FigureScene& scene, Face f)
{
    return scene.surface->data(f).facing == Facing::Back;
}

//! The depth of an element at a point on the paper, or nothing where the point is outside.
std::optional<double> depth_at(const FigureScene& scene, Face f, const Vec2& point)
{
    const Quad q = quad(*scene.surface, f);
    const Polygon p = outline_of(scene, f);
    for (const auto& [b, c] : {std::pair{1, 2}, std::pair{2, 3}}) {
        const double area = cross_2d(p[b] - p[0], p[c] - p[0]);
        const double v = cross_2d(point - p[0], p[c] - p[0]) / area;
        const double w = cross_2d(p[b] - p[0], point - p[0]) / area;
        if (area != 0 && v >= 0 && w >= 0 && v + w <= 1) {
            const auto z = [&](int k) { return depth(scene.camera, scene.surface->point(Vertex(q[k]))); };
            return z(0) + v * (z(b) - z(0)) + w * (z(c) - z(0));
        }
    }
    return {};
}

Vec3 on_element(const FigureScene& scene, Face f, double u, double v)
{
    const Quad q = quad(*scene.surface, f);
    const auto x = [&](int k) -> Vec3 { return scene.surface->point(Vertex(q[k])); };
    return (1 - u) * ((1 - v) * x(0) + v * x(3)) + u * ((1 - v) * x(1) + v * x(2));
}

bool hidden(const FigureScene& scene, const Vec3& point, Face own, const std::vector<Face>& others)
{
    const Vec2 on_paper = project(scene.camera, point);
    const double z = depth(scene.camera, point);
    const double tolerance = 3 / scene.camera.scale;
    return std::any_of(others.begin(), others.end(), [&](Face f) {
        const auto there = f == own ? std::nullopt : depth_at(scene, f, on_paper);
        return there && *there > z + tolerance;
    });
}

//! Those of \p others whose bounds meet the element's.
std::vector<Face> near_on_paper(const FigureScene& scene, Face f, const std::vector<Face>& others)
{
    const auto box = [&](Face g) {
        Box b;
        for (const Vec2& p : outline_of(scene, g)) {
            b.min = b.min.cwiseMin(p);
            b.max = b.max.cwiseMax(p);
        }
        return b;
    };
    const Box own = box(f);
    std::vector<Face> result;
    for (const Face g : others) {
        const Box b = box(g);
        if (g != f && (b.min.array() <= own.max.array()).all() && (own.min.array() <= b.max.array()).all()) {
            result.push_back(g);
        }
    }
    return result;
}

} // namespace

bool from_outside(const FigureScene& scene, Face f)
{
    return element_normal(*scene.surface, f).dot(scene.camera.view.toward) > 0;
}

unsigned element_tint(const FigureScene& scene, Face f, Paint paint)
{
    if (paint == Paint::Next) {
        return colour::next;
    }
    if (paint == Paint::Ghost || paint == Paint::Removed) {
        return colour::ghost;
    }
    if (paint == Paint::Faint) {
        return from_outside(scene, f) ? colour::faint : colour::faint_inside;
    }
    if (!from_outside(scene, f)) {
        return colour::inside;
    }
    const double light = shade(scene, element_normal(*scene.surface, f));
    if (paint == Paint::Chapter) {
        return mixed(colour::chapter_dark, colour::chapter_light, light);
    }
    return mixed(colour::built_dark, colour::built_light, light);
}

namespace {

bool has_dots(const FigureScene& scene, Face f, Paint paint)
{
    return flipped(scene, f) && (paint == Paint::Next || from_outside(scene, f));
}

//! The edges of a part of an element that are edges of the element.
void add_common_edges(const Polygon& element, const Polygon& part, std::vector<Polygon>& edges)
{
    constexpr double same = 0.02; // points
    for (std::size_t k = 0; k < element.size(); ++k) {
        const Vec2 start = element[k];
        const Vec2 along = (element[(k + 1) % element.size()] - start).normalized();
        const auto on_edge = [&](const Vec2& x) { return std::abs(cross_2d(along, x - start)) < same; };
        for (std::size_t i = 0; i < part.size(); ++i) {
            const Vec2& a = part[i];
            const Vec2& b = part[(i + 1) % part.size()];
            if (on_edge(a) && on_edge(b) && (b - a).norm() > same) {
                edges.push_back({a, b});
            }
        }
    }
}

} // namespace

void draw_flip_dots(PdfCanvas& canvas, const FigureScene& scene, Face f, Paint paint)
{
    if (has_dots(scene, f, paint)) {
        draw_dots(canvas, outline_of(scene, f),
                  paint == Paint::Next    ? 0xFFFFFF
                  : paint == Paint::Faint ? colour::ghost_line
                                          : colour::dot);
    }
}

Polygon outline_of(const FigureScene& scene, Face f)
{
    Polygon p;
    for (const int v : quad(*scene.surface, f)) {
        p.push_back(project(scene.camera, scene.surface->point(Vertex(v))));
    }
    return p;
}

double polygon_area(const Polygon& polygon)
{
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        sum += cross_2d(polygon[i], polygon[(i + 1) % polygon.size()]) / 2;
    }
    return std::abs(sum);
}

double seen_part(const FigureScene& scene, Face f, const std::vector<Face>& others)
{
    constexpr int samples = 6;
    const std::vector<Face> near = near_on_paper(scene, f, others);
    int seen = 0;
    for (int i = 0; i < samples; ++i) {
        for (int j = 0; j < samples; ++j) {
            seen += !hidden(scene, on_element(scene, f, (i + 0.5) / samples, (j + 0.5) / samples), f, near);
        }
    }
    return static_cast<double>(seen) / (samples * samples);
}

namespace {

//! An element bent so much that one half hides part of the other's: they reach beyond the outline of its corners.
void draw_folded_halves(PdfCanvas& canvas, const Polygon& p, unsigned tint, const Line& line)
{
    const double one = cross_2d(p[1] - p[0], p[2] - p[0]);
    const double other = cross_2d(p[2] - p[0], p[3] - p[0]);
    if (one * other < 0) {
        canvas.fill_and_outline({p[0], p[1], p[2]}, tint, line);
        canvas.fill_and_outline({p[0], p[2], p[3]}, tint, line);
    }
}

} // namespace

void draw_element(PdfCanvas& canvas, const FigureScene& scene, Face f, Paint paint)
{
    const Polygon p = outline_of(scene, f);
    draw_folded_halves(canvas, p, element_tint(scene, f, paint), edge_line(paint));
    canvas.fill_and_outline(p, element_tint(scene, f, paint), edge_line(paint));
    if (paint == Paint::Removed) {
        const Line cross_line{1.4, 0x000000, 0};
        canvas.stroke({at(p, 0.25, 0.25), at(p, 0.75, 0.75)}, cross_line);
        canvas.stroke({at(p, 0.75, 0.25), at(p, 0.25, 0.75)}, cross_line);
    } else if (paint != Paint::Ghost) {
        draw_flip_dots(canvas, scene, f, paint);
    }
}

void draw_part(PdfCanvas& canvas, const FigureScene& scene, const Painted& painted, Paint paint)
{
    const Polygon p = outline_of(scene, painted.face);
    const unsigned tint = element_tint(scene, painted.face, paint);
    std::vector<Polygon> pieces; // triangles: only whole elements are drawn as quads
    std::vector<Polygon> edges;
    for (const Polygon& part : painted.part) {
        for (std::size_t i = 2; i < part.size(); ++i) {
            pieces.push_back({part[0], part[i - 1], part[i]});
        }
        add_common_edges(p, part, edges);
    }
    canvas.fills(pieces, tint);
    for (const Polygon& part : painted.part) {
        if (has_dots(scene, painted.face, paint)) {
            canvas.clipped(part, [&] { draw_flip_dots(canvas, scene, painted.face, paint); });
        }
    }
    canvas.strokes(edges, edge_line(paint));
}

void draw_joined_sides(PdfCanvas& canvas, const FigureScene& scene, Face f, const std::vector<int>& sides,
                       const std::vector<Face>& built)
{
    constexpr int pieces = 12;
    const std::vector<Face> near = near_on_paper(scene, f, built);
    const Quad q = quad(*scene.surface, f);
    for (const int side : sides) {
        const Vec3 a = scene.surface->point(Vertex(q[side]));
        const Vec3 b = scene.surface->point(Vertex(q[(side + 1) % 4]));
        Polygon chain;
        const auto flush = [&] {
            if (chain.size() > 1) {
                canvas.stroke({chain.front(), chain.back()}, {3, 0x000000, 0});
            }
            chain.clear();
        };
        for (int i = 0; i <= pieces; ++i) {
            const Vec3 x = a + (b - a) * i / pieces;
            if (hidden(scene, x, f, near)) {
                flush();
            } else {
                chain.push_back(project(scene.camera, x));
            }
        }
        flush();
    }
}

namespace {

//! How far one can go from a point before leaving the room.
double way_out(const Vec2& from, const Vec2& along, const Box& room)
{
    double way = 1e9;
    for (const int axis : {0, 1}) {
        if (along[axis] != 0) {
            const double wall = along[axis] > 0 ? room.max[axis] : room.min[axis];
            way = std::min(way, (wall - from[axis]) / along[axis]);
        }
    }
    return std::max(0.0, way);
}

//! Where the element comes from, as a direction on the paper.
Vec2 arrow_direction(const FigureScene& scene, Face f, const std::vector<int>& joined)
{
    const Polygon p = outline_of(scene, f);
    Vec2 from = Vec2::Zero();
    for (const int side : joined) {
        from -= (p[side] + p[(side + 1) % 4]) / 2 - middle(p);
    }
    const double size = std::sqrt(polygon_area(p));
    if (from.norm() < 0.15 * size) { // joined all round, or on two opposite sides: it comes from outside
        const Vec3 normal = element_normal(*scene.surface, f);
        from = Vec2(normal.dot(scene.camera.view.right), -normal.dot(scene.camera.view.up)) + Vec2(0.25, -0.35);
    }
    return from.normalized();
}

} // namespace

void draw_arrow(PdfCanvas& canvas, const FigureScene& scene, Face f, const Arrow& arrow)
{
    const Polygon p = outline_of(scene, f);
    const Vec2 from = arrow_direction(scene, f, arrow.joined);
    const double size = std::sqrt(polygon_area(p));
    double reach = 0; // how far the element itself extends that way
    for (const Vec2& corner : p) {
        reach = std::max(reach, (corner - middle(p)).dot(from));
    }
    const double length = std::clamp(0.8 * size, 14.0, 26.0);
    const Vec2 tip = middle(p) + from * (0.45 * reach);
    const Vec2 tail = tip + from * std::clamp(way_out(tip, from, arrow.room), 12.0, length + 0.3 * reach);
    const bool inward = arrow.away > 0;
    const Vec2 point = inward ? tip : tail;
    const Vec2 back = (inward ? from : Vec2(-from)) * 6.5;
    const Vec2 across(-back.y() * 0.55, back.x() * 0.55);
    const Polygon head = {point, point + back + across, point + back - across};
    const Vec2 shaft_end = point + 0.8 * back;
    const Vec2 shaft_start = inward ? tail : tip;
    canvas.stroke({shaft_start, shaft_end}, {5, 0xFFFFFF, 0});
    canvas.fill_and_outline(head, 0xFFFFFF, {3, 0xFFFFFF, 0});
    canvas.stroke({shaft_start, shaft_end}, {2.2, 0x000000, 0});
    canvas.fill(head, 0x000000);
}

} // namespace rhombloom
