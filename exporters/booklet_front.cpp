#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "exporters/booklet_pages.h"

namespace rhombloom {

namespace {

//! A small sample of what the step pictures show, drawn about the origin, 60 x 40 points.
struct Sample
{
    const char* words;
    void (*draw)(PdfCanvas&);
};

Polygon rhomb(double x = 0)
{
    return {{x - 22, 10}, {x + 2, 16}, {x + 22, -10}, {x - 2, -16}};
}

const Line thin{0.5, colour::line, 0};

void red(PdfCanvas& canvas)
{
    canvas.fill_and_outline(rhomb(), colour::next, {0.9, 0x000000, 0});
}

void small_arrow(PdfCanvas& canvas, const Vec2& tail, const Vec2& tip)
{
    const Vec2 back = 6 * (tail - tip).normalized();
    const Vec2 across(-0.55 * back.y(), 0.55 * back.x());
    canvas.stroke({tail, tip + 0.8 * back}, {2.2, 0x000000, 0});
    canvas.fill({tip, tip + back + across, tip + back - across}, 0x000000);
}

void joined(PdfCanvas& canvas)
{
    canvas.fill_and_outline({{-30, -6}, {-8, -16}, {-2, 14}, {-24, 18}}, colour::built_light, thin);
    canvas.fill_and_outline({{-8, -16}, {14, -10}, {20, 16}, {-2, 14}}, colour::next, {0.9, 0x000000, 0});
    canvas.stroke({{-8, -16}, {-2, 14}}, {3, 0x000000, 0});
    small_arrow(canvas, {34, -4}, {17, 1});
}

void dotted(PdfCanvas& canvas)
{
    canvas.fill_and_outline(rhomb(), colour::built_light, thin);
    canvas.dots({{{-12, 6}, {4, 10}}, {{-8, 0}, {8, 0.5}}, {{-4, -10}, {12, -6}}}, 1.8, 5.5, colour::dot);
}

void from_inside(PdfCanvas& canvas)
{
    canvas.fill_and_outline(rhomb(), colour::inside, thin);
}

void ghost(PdfCanvas& canvas)
{
    canvas.fill_and_outline(rhomb(), colour::ghost, {0.35, colour::ghost_line, 0});
}

void named(PdfCanvas& canvas)
{
    canvas.fill_and_outline(rhomb(), colour::built_light, thin);
    canvas.text("17", {0, 3}, {8, 0x000000, Align::Centre, 0xFFFFFF});
}

void turned(PdfCanvas& canvas)
{
    draw_turn_arrow(canvas, {0, 0}, 10, true);
}

void magnified(PdfCanvas& canvas)
{
    canvas.arc({-16, 8}, 7, 0, two_pi, {0.8, 0x404040, 0});
    canvas.stroke({{-9.5, 4.5}, {-4, 1}}, {0.8, 0x404040, 0});
    canvas.disc({10, -4}, 16, 0xFFFFFF, {0.8, 0x404040, 0});
    canvas.fill_and_outline({{2, -12}, {18, -8}, {17, 5}, {3, 4}}, colour::next, {0.7, 0x000000, 0});
}

void removed(PdfCanvas& canvas)
{
    canvas.fill_and_outline(rhomb(), colour::ghost, {1.4, 0x000000, 3});
    canvas.stroke({{-10, 5}, {10, -5}}, {1.4, 0x000000, 0});
    canvas.stroke({{2, 9}, {-2, -9}}, {1.4, 0x000000, 0});
}

const Sample samples[] = {
    {"Red, the only dark one: the element to put in now. Every picture shows the model as it stands, from outside.",
     red},
    {"Thick lines: the sides to join in this step. The arrow shows where the element comes from.", joined},
    {"Dots: a flipped element. Turn it over before you hook it in. Without dots, the front looks outward.", dotted},
    {"Blue-grey, in a print without colours the darker grey: seen from inside, through an opening.", from_inside},
    {"Thin grey lines: what is still missing.", ghost},
    {"A number on an element: the step in which it was put in.", named},
    {"Circle: the place magnified, with the real hooks. Look which part lies over which.", magnified},
    {"The view stays the same as long as it can. When it changes, turn the model in your hands as written.", turned},
    {"White with a cross: take this element out again. A coloured bar behind the words says: here something is opened "
     "for the next part; the arrow points away.",
     removed}};

double text_width(const BookletSources& s)
{
    return s.layout.paper.width - 2 * page_margin;
}

//! A bullet and a paragraph; returns the y below.
double item(PdfCanvas& canvas, const BookletSources& sources, double y, const std::string& words)
{
    double next = y;
    canvas.tagged("P", [&] {
        canvas.disc(Vec2(page_margin + 3, y - 4), 1.8, 0x000000, {0.1, 0x000000, 0});
        next = canvas.paragraph(words, Vec2(page_margin + 14, y), text_width(sources) - 14, {11}, 15) + 4;
    });
    return next;
}

//! Many materials have their thickness in the name.
std::string sheet_words(const std::string& material, double thickness)
{
    const std::string thick = to_fixed(thickness, 2) + " mm";
    if (material.find(" " + thick) != std::string::npos) {
        return material;
    }
    return (material.empty() ? "Sheet" : material) + ", " + thick + " thick";
}

void draw_contents(PdfCanvas& canvas, const BookletSources& sources, double y)
{
    canvas.tagged("H2", [&] { canvas.text("Chapters", Vec2(page_margin, y), {15}); });
    const auto& chapters = sources.layout.chapters;
    const double room = sources.layout.paper.height - page_margin - y - 12;
    const double leading = std::min(16.0, room / std::max<double>(1, static_cast<double>(chapters.size())));
    for (std::size_t c = 0; c < chapters.size(); ++c) {
        const std::string line = std::to_string(c + 1) + "  " + chapters[c].title + ": " +
                                 plural(chapters[c].count, "step") + ", page " + std::to_string(chapters[c].page);
        y += c == 0 ? 20 : leading;
        canvas.link(
            chapter_destination(static_cast<int>(c)), line, Vec2(page_margin, y),
            {canvas.fitting_size(line, text_width(sources), std::min(11.0, 0.8 * leading)), 0x004080, Align::Left, 0});
    }
}

//! The flat piece as it comes from the sheet, once with each face up.
void draw_flat_piece(PdfCanvas& canvas, const BookletSources& sources, Facing facing, const Vec2& at, double width)
{
    const Element& e = sources.element;
    const Vec3 lean(e.la * std::cos(e.alpha), e.la * std::sin(e.alpha), 0);
    SurfaceLists lists;
    const Vec3 right(e.lb, 0, 0);
    lists.positions = {Vec3::Zero(), right, right + lean, lean};
    lists.sides = {Side::Long, Side::Short, Side::Long, Side::Short};
    if (facing == Facing::Back) { // mirrored: the same corners, acute where the short side leaves
        for (Vec3& p : lists.positions) {
            p.x() = e.lb + lean.x() - p.x();
        }
        lists.positions = {lists.positions[0], lists.positions[3], lists.positions[2], lists.positions[1]};
        lists.sides = {Side::Short, Side::Long, Side::Short, Side::Long};
    }
    lists.quads = {{0, 1, 2, 3}};
    lists.facing = {facing};
    lists.component = {0};
    lists.serial = {0};
    const auto surface = make_surface(lists);
    expects(surface.has_value(), "draw_flat_piece: one element");
    const Viewpoint above{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    const FigureScene scene{&*surface, {above, (right + lean) / 2, width / (e.lb + lean.x() + 0.15 * e.la)}};
    canvas.shifted(at, [&] { draw_piece(canvas, scene, {Face(0), Paint::Built}, sources.contour); });
}

} // namespace

void draw_how_to_read(PdfCanvas& canvas, const BookletSources& sources)
{
    draw_heading(canvas, sources, "How to read this booklet");
    double y = page_margin + 66;
    for (const Sample& sample : samples) {
        canvas.figure(sample.words, [&] { canvas.shifted(Vec2(page_margin + 34, y), [&] { sample.draw(canvas); }); });
        canvas.tagged("P", [&] {
            canvas.paragraph(sample.words, Vec2(page_margin + 84, y), text_width(sources) - 84, {11}, 14);
        });
        y += 48;
    }
    draw_contents(canvas, sources, y + 10);
}

void draw_parts(PdfCanvas& canvas, const BookletSources& sources, const BookletOptions& options)
{
    draw_heading(canvas, sources, "Parts and tools");
    const Scorecard& score = sources.plan.scorecard;
    const auto final_count = static_cast<int>(sources.replay.surface.n_faces());
    double y = page_margin + 66;
    y = item(canvas, sources, y,
             plural(score.parts_needed, "element") + ", all of the same shape" +
                 (score.parts_needed > final_count ? " (the finished model has " + std::to_string(final_count) +
                                                         "; the others are taken out again on the way)"
                                                   : ""));
    y = item(canvas, sources, y,
             sheet_words(options.material, sources.element.thickness) +
                 (options.sheets > 0 ? ", cut from " + plural(options.sheets, "sheet") : ""));
    y = item(canvas, sources, y, "A table, good light and " + duration(score.minutes, 5));
    y = item(canvas, sources, y, "A few small clips or some tape hold the rim while you work");
    y = item(canvas, sources, y, "No glue and no tools: try the joint on the next page with two elements first");
    const double width = 0.42 * text_width(sources);
    const double middle = y + 30 + 0.45 * width;
    canvas.figure("The element with its front up and, dotted, flipped.", [&] {
        draw_flat_piece(canvas, sources, Facing::Front, Vec2(page_margin + 0.25 * text_width(sources), middle), width);
        draw_flat_piece(canvas, sources, Facing::Back, Vec2(page_margin + 0.75 * text_width(sources), middle), width);
    });
    const double below = middle + 0.45 * width + 6;
    canvas.tagged("Caption", [&] {
        canvas.text("Front: its two hooked, scooped sides are the short ones",
                    Vec2(page_margin + 0.25 * text_width(sources), below), {9.5, 0x202020, Align::Centre, 0});
        canvas.text("Flipped: the same element turned over, drawn with dots",
                    Vec2(page_margin + 0.75 * text_width(sources), below), {9.5, 0x202020, Align::Centre, 0});
    });
}

} // namespace rhombloom
