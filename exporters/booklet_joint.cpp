#include <cmath>

#include "exporters/booklet_pages.h"

namespace rhombloom {

namespace {

Vec3 rotated(const Vec3& v, double angle)
{
    return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y(),
            v.z()};
}

//! Two flat elements: A with a short side to the right, B with a long side on it; then B moved off.
struct Pair
{
    Facing facing = Facing::Front; //!< of B
    double apart = 0;              //!< mm
    double swung = 0;              //!< radians, B about the lower node, away from A
};

Surface flat_pair(const Element& e, const Pair& pair)
{
    const Vec3 lean(e.la * std::cos(e.alpha), e.la * std::sin(e.alpha), 0);
    const Vec3 right(e.lb, 0, 0);
    const Vec3 up = rotated(lean, -pair.swung);
    const double corner = pair.facing == Facing::Front ? e.alpha : beta(e);
    const Vec3 away = rotated(-up, corner); // la long, like every hooked side
    const Vec3 off = right + pair.apart * rotated(lean, -pi / 2).normalized();
    SurfaceLists lists;
    lists.positions = {Vec3::Zero(), right, right + lean, lean, off + up, off, off + away, off + up + away};
    lists.sides = {Side::Long, Side::Short, Side::Long, Side::Short, Side::Long, Side::Short, Side::Long, Side::Short};
    lists.quads = {{0, 1, 2, 3}, {4, 5, 6, 7}};
    lists.facing = {Facing::Front, pair.facing};
    lists.component = {0, 0};
    lists.serial = {0, 1};
    auto surface = make_surface(lists);
    expects(surface.has_value(), "flat_pair: two separate elements");
    return std::move(*surface);
}

Viewpoint from_above()
{
    return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
}

//! What lies over what in a panel.
enum class Over
{
    Nothing,   //!< apart
    FirstHook, //!< the lower hook of A over B
    Hooked,    //!< both hooks of A over B, B's lip over A
    Wrong      //!< B over A's hooks
};

struct Panel
{
    std::string words;
    Pair pair;
    Over over = Over::Hooked;
    bool close_up = false;
};

void draw_cross(PdfCanvas& canvas, double half)
{
    for (const double sign : {-1.0, 1.0}) {
        const Polygon line = {Vec2(-half, -sign * half), Vec2(half, sign * half)};
        canvas.stroke(line, {8, 0xFFFFFF, 0});
        canvas.stroke(line, {4, 0x000000, 0});
    }
}

double panel_scale(const Element& e, double width)
{
    return 1.1 * width / (2 * e.lb + 2 * e.la * std::cos(e.alpha) + 0.4 * e.la);
}

Scene panel_scene(const Surface& surface, const Element& e, double scale)
{
    const Vec3 middle(e.lb + 0.5 * e.la * std::cos(e.alpha), 0.5 * e.la * std::sin(e.alpha), 0);
    return {&surface, {from_above(), middle, scale}};
}

//! Bodies first, A under B; then what lies over B again.
void draw_pair(PdfCanvas& canvas, const Scene& scene, const PieceContour& contour, Over over)
{
    const Piece a{Face(0), Paint::Built};
    const Piece b{Face(1), Paint::Next};
    draw_piece(canvas, scene, a, contour);
    draw_piece(canvas, scene, b, contour);
    if (over == Over::Hooked || over == Over::FirstHook) {
        draw_flaps(canvas, scene, a, contour, 1, over == Over::Hooked ? 2 : 1);
    }
    if (over == Over::FirstHook || over == Over::Nothing) {
        draw_arrow(canvas, scene, Face(1), {0}, 1);
    }
    if (over == Over::Wrong) {
        draw_cross(canvas, 60);
    }
}

void draw_close_up(PdfCanvas& canvas, const Scene& scene, const PieceContour& contour, double radius)
{
    Scene near = scene;
    near.camera.scale *= 3.4;
    near.camera.look_at =
        scene.surface->point(Vertex(1)) + 0.17 * (scene.surface->point(Vertex(2)) - scene.surface->point(Vertex(1)));
    canvas.disc(Vec2::Zero(), radius, 0xFFFFFF, {0.8, 0x404040, 0});
    canvas.clipped_to_disc(Vec2::Zero(), radius - 0.5, [&] { draw_pair(canvas, near, contour, Over::Hooked); });
}

void draw_panel(PdfCanvas& canvas, const BookletSources& sources, int index, const Panel& panel, const Vec2& corner,
                const Vec2& size)
{
    const Surface surface = flat_pair(sources.element, panel.pair);
    const Scene scene = panel_scene(surface, sources.element, panel_scale(sources.element, size.x()));
    canvas.outline({corner, corner + Vec2(size.x(), 0), corner + size, corner + Vec2(0, size.y())}, {0.6, 0xB0B0B0, 0});
    canvas.tagged("P", [&] {
        canvas.text(std::to_string(index), corner + Vec2(8, 22), {18});
        canvas.paragraph(panel.words, corner + Vec2(28, 15), size.x() - 36, {9.5}, 12);
    });
    canvas.figure(panel.words, [&] {
        canvas.shifted(corner + Vec2(size.x() / 2, 0.6 * size.y()), [&] {
            if (panel.close_up) {
                draw_close_up(canvas, scene, sources.contour, 0.34 * size.y());
            } else {
                draw_pair(canvas, scene, sources.contour, panel.over);
            }
        });
    });
}

} // namespace

void draw_joint(PdfCanvas& canvas, const BookletSources& sources)
{
    const std::vector<Panel> panels = {
        {"A long side (no hooks) always meets a short side (two hooks).",
         {Facing::Front, 0.28 * sources.element.la, 0},
         Over::Nothing,
         false},
        {"Slide the long side under the first hook. The hooks lie on the outside of the model.",
         {Facing::Front, 0, radians(11)},
         Over::FirstHook,
         false},
        {"Bend the long side a little, slide it under the second hook and let go. It stays slightly bowed.",
         {},
         Over::Hooked,
         false},
        {"Close up: the hook lies over the long side, the lip of the long side over the other element.",
         {},
         Over::Hooked,
         true},
        {"Flipped (dots): the same joint with the element turned over. It now leans the other way.",
         {Facing::Back, 0, 0},
         Over::Hooked,
         false},
        {"Not like this: with the long side over the hooks it slips out again.", {}, Over::Wrong, false}};
    draw_heading(canvas, "How one joint is hooked");
    const PaperSize& paper = sources.layout.paper;
    const double gap = 14;
    const Vec2 size((paper.width - 2 * page_margin - gap) / 2, (paper.height - 2 * page_margin - 50 - 2 * gap) / 3);
    for (int i = 0; i < static_cast<int>(panels.size()); ++i) {
        const Vec2 corner(page_margin + (i % 2) * (size.x() + gap), page_margin + 50 + (i / 2) * (size.y() + gap));
        draw_panel(canvas, sources, i + 1, panels[i], corner, size);
    }
}

} // namespace rhombloom
