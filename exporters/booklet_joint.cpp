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

void extend(Box& box, const Box& other)
{
    box.min = box.min.cwiseMin(other.min);
    box.max = box.max.cwiseMax(other.max);
}

//! Bounds of both pieces with their hooks, mm, seen from above with y down.
Box bounds_of(const Pair& pair, const BookletSources& sources)
{
    const Surface surface = flat_pair(sources.element, pair);
    const FigureScene scene{&surface, {from_above(), Vec3::Zero(), 1}};
    Box box;
    for (const int f : {0, 1}) {
        for (const Vec2& p : piece_on_paper(scene, Face(f), sources.contour)) {
            extend(box, {p, p});
        }
    }
    return box;
}

Vec2 figure_size(const Vec2& panel)
{
    return panel - Vec2(30, 62); // below the words, with room for the arrow
}

//! The first piece stays where it is from panel to panel: bounds are those of all panels with the same facing.
struct Frames
{
    Box front, back;
    double scale = 1;

    FigureScene scene(const Surface& surface, Facing facing) const
    {
        const Box& box = facing == Facing::Front ? front : back;
        const Vec2 middle = (box.min + box.max) / 2;
        return {&surface, {from_above(), Vec3(middle.x(), -middle.y(), 0), scale}};
    }
};

Frames frames_for(const std::vector<Panel>& panels, const BookletSources& sources, const Vec2& panel_size)
{
    Frames frames;
    for (const Panel& panel : panels) {
        extend(panel.pair.facing == Facing::Front ? frames.front : frames.back, bounds_of(panel.pair, sources));
    }
    const Vec2 widest = (frames.front.max - frames.front.min).cwiseMax(frames.back.max - frames.back.min);
    frames.scale = figure_size(panel_size).cwiseQuotient(widest).minCoeff();
    return frames;
}

//! Bodies first, A under B; then what lies over B again.
void draw_pair(PdfCanvas& canvas, const FigureScene& scene, const PieceContour& contour, Over over)
{
    const DrawnPiece a{Face(0), Paint::Built};
    const DrawnPiece b{Face(1), Paint::Next};
    draw_piece(canvas, scene, a, contour);
    draw_piece(canvas, scene, b, contour);
    if (over == Over::Hooked || over == Over::FirstHook) {
        draw_flaps(canvas, scene, a, contour, 1, over == Over::Hooked ? 2 : 1);
    }
    if (over == Over::FirstHook || over == Over::Nothing) {
        draw_arrow(canvas, scene, Face(1), {{0}});
    }
    if (over == Over::Wrong) {
        draw_cross(canvas, 60);
    }
}

void draw_close_up(PdfCanvas& canvas, const FigureScene& scene, const PieceContour& contour, double radius)
{
    FigureScene near = scene;
    near.camera.scale *= 3.4;
    near.camera.look_at =
        scene.surface->point(Vertex(1)) + 0.17 * (scene.surface->point(Vertex(2)) - scene.surface->point(Vertex(1)));
    canvas.disc(Vec2::Zero(), radius, 0xFFFFFF, {0.8, 0x404040, 0});
    canvas.clipped_to_disc(Vec2::Zero(), radius - 0.5, [&] { draw_pair(canvas, near, contour, Over::Hooked); });
}

struct PanelPlace
{
    int number = 1;
    Vec2 corner, size;
};

void draw_panel(PdfCanvas& canvas, const BookletSources& sources, const Panel& panel, const PanelPlace& place,
                const Frames& frames)
{
    const Vec2& corner = place.corner;
    const Vec2& size = place.size;
    const Surface surface = flat_pair(sources.element, panel.pair);
    const FigureScene scene = frames.scene(surface, panel.pair.facing);
    canvas.outline({corner, corner + Vec2(size.x(), 0), corner + size, corner + Vec2(0, size.y())}, {0.6, 0xB0B0B0, 0});
    canvas.tagged("P", [&] {
        canvas.text(std::to_string(place.number), corner + Vec2(8, 22), {18});
        canvas.paragraph(panel.words, corner + Vec2(28, 15), size.x() - 36, {9.5}, 12);
    });
    canvas.figure(panel.words, [&] {
        canvas.shifted(corner + Vec2(size.x() / 2, size.y() / 2 + 18), [&] {
            if (panel.close_up) {
                draw_close_up(canvas, scene, sources.contour, 0.36 * size.y());
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
    draw_heading(canvas, sources, "How one joint is hooked");
    const PaperSize& paper = sources.layout.paper;
    const double gap = 14;
    const Vec2 size((paper.width - 2 * page_margin - gap) / 2, (paper.height - 2 * page_margin - 50 - 2 * gap) / 3);
    const Frames frames = frames_for(panels, sources, size);
    for (int i = 0; i < static_cast<int>(panels.size()); ++i) {
        const Vec2 corner(page_margin + (i % 2) * (size.x() + gap), page_margin + 50 + (i / 2) * (size.y() + gap));
        draw_panel(canvas, sources, panels[i], {i + 1, corner, size}, frames);
    }
}

} // namespace rhombloom
