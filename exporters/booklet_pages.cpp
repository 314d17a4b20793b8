#include "exporters/booklet_pages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/text.h"

namespace rhombloom {

std::string plural(int count, const std::string& noun)
{
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string duration(double minutes)
{
    const int rounded = static_cast<int>(std::ceil(minutes / 5) * 5);
    return rounded < 90 ? "about " + std::to_string(rounded) + " minutes"
                        : "about " + to_fixed(std::round(rounded / 30.0) / 2, 1) + " hours";
}

void draw_heading(PdfCanvas& canvas, const std::string& text)
{
    canvas.tagged("H1", [&] {
        canvas.text(text, Vec2(page_margin, page_margin + 24), {24, 0x000000, Align::Left, 0});
    });
}

namespace {

constexpr int portrait_view = 1; // a little from the side, a little from above
constexpr int most_hooked = 300; // elements of a model that is drawn with its hooks

double text_width(const BookletSources& s)
{
    return s.layout.paper.width - 2 * page_margin;
}

std::vector<Face> all_faces(const Surface& surface)
{
    std::vector<Face> faces;
    for (const Face f : surface.faces()) {
        faces.push_back(f);
    }
    return faces;
}

//! Faces in painter's order, those of one chapter marked.
void draw_faces(PdfCanvas& canvas, const FigureScene& scene, const std::vector<Face>& faces,
                const std::vector<char>& marked)
{
    for (const Face f : painter_order(scene, faces)) {
        draw_element(canvas, scene, f, !marked.empty() && marked[f.idx()] ? Paint::Chapter : Paint::Faint);
    }
}

Camera model_camera(const BookletSources& sources, int view, const Vec2& half)
{
    return fitted_camera(sources.replay.surface, all_faces(sources.replay.surface), {view}, 0.97 * half);
}

//! Where the plane of a triangle is at (x, y), or nothing beside it.
std::optional<double> height_at(const std::array<Vec3, 3>& t, const Vec3& at)
{
    const auto turn = [](const Vec3& a, const Vec3& b, const Vec3& c) {
        return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    };
    const double area = turn(t[0], t[1], t[2]);
    const double u = turn(at, t[1], t[2]) / area;
    const double v = turn(t[0], at, t[2]) / area;
    const bool inside = area != 0 && u >= 0 && v >= 0 && u + v <= 1;
    return inside ? std::optional(u * t[0].z() + v * t[1].z() + (1 - u - v) * t[2].z()) : std::nullopt;
}

//! The highest point of the model above its centre of mass: it hangs there as it stands. Where there is nothing above
//! the centre: the highest of all.
Vec3 hanging_point(const Surface& surface)
{
    Vec3 centre = Vec3::Zero();
    Vec3 highest = Vec3::Constant(-1e300);
    for (const Face f : surface.faces()) {
        centre += element_centre(surface, f) / static_cast<double>(surface.n_faces());
    }
    std::optional<double> top;
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        const auto corner = [&](int k) -> Vec3 { return surface.point(Vertex(q[k])); };
        for (const auto& t :
             {std::array{corner(0), corner(1), corner(2)}, std::array{corner(0), corner(2), corner(3)}}) {
            const std::optional<double> z = height_at(t, centre);
            top = z && (!top || *z > *top) ? z : top;
            highest = t[0].z() > highest.z() ? t[0] : highest;
        }
    }
    return top && *top > centre.z() ? Vec3(centre.x(), centre.y(), *top) : highest;
}

} // namespace

std::string chapter_destination(int chapter)
{
    return "chapter-" + std::to_string(chapter + 1);
}

Camera draw_model(PdfCanvas& canvas, const BookletSources& sources, const Vec2& centre, const Vec2& half, int view,
                  int marked)
{
    const Surface& surface = sources.replay.surface;
    const std::vector<Face> faces = all_faces(surface);
    const bool hooked = static_cast<int>(faces.size()) <= most_hooked;
    const FigureScene scene{&surface, model_camera(sources, view, half)};
    std::vector<DrawnPiece> pieces;
    for (const Face f : painter_order(scene, faces)) {
        const bool hooks = hooked && from_outside(scene, f) && seen_part(scene, f, faces) > 0.95;
        pieces.push_back({f, f.idx() == marked ? Paint::Next : Paint::Built, hooks});
    }
    canvas.shifted(centre, [&] { draw_pieces(canvas, scene, pieces, sources.contour); });
    return scene.camera;
}

void draw_cover(PdfCanvas& canvas, const BookletSources& sources, const std::string& title,
                const BookletOptions& options)
{
    const PaperSize& paper = sources.layout.paper;
    const Scorecard& score = sources.plan.scorecard;
    canvas.tagged("H1",
                  [&] { canvas.paragraph(title, Vec2(page_margin, page_margin + 40), text_width(sources), {36}, 42); });
    canvas.figure("The finished model: " + title + ".", [&] {
        draw_model(canvas, sources, Vec2(paper.width / 2, paper.height * 0.5),
                   Vec2(text_width(sources) / 2, paper.height * 0.32), portrait_view);
    });
    std::string facts = plural(static_cast<int>(sources.replay.surface.n_faces()), "element");
    facts += options.sheets > 0 ? "   \u00B7   " + plural(options.sheets, "sheet") : "";
    facts += "   \u00B7   " + duration(score.minutes);
    canvas.tagged("P", [&] {
        canvas.text(facts, Vec2(page_margin, paper.height - page_margin - 14), {15, 0x202020, Align::Left, 0});
    });
}

void draw_chapter(PdfCanvas& canvas, const BookletSources& sources, int chapter)
{
    const Chapter& c = sources.layout.chapters[chapter];
    const PaperSize& paper = sources.layout.paper;
    canvas.destination(chapter_destination(chapter), 0);
    canvas.bookmark(0, c.title, 0);
    draw_heading(canvas, std::to_string(chapter + 1) + "  " + c.title);
    canvas.tagged("P", [&] {
        canvas.text("Steps " + std::to_string(c.first + 1) + " to " + std::to_string(c.first + c.count),
                    Vec2(page_margin, page_margin + 46), {12, 0x404040, Align::Left, 0});
    });
    const int stage = sources.plan.steps[c.first + c.count - 1].stage;
    const Surface& surface = stage_surface(sources.replay, stage);
    const std::vector<int> face = faces_of_elements(sources.replay, sources.plan, stage);
    std::vector<char> present(face.size(), 0);
    std::vector<char> marked(surface.n_faces(), 0);
    std::vector<Face> faces;
    for (int k = 0; k < c.first + c.count; ++k) {
        const Step& step = sources.plan.steps[k];
        present[step.element] = step.kind != StepKind::Remove;
        if (k >= c.first && face[step.element] >= 0) {
            marked[face[step.element]] = step.kind == StepKind::Insert;
        }
    }
    for (std::size_t e = 0; e < present.size(); ++e) {
        if (present[e] && face[e] >= 0) {
            faces.emplace_back(face[e]);
        }
    }
    const Vec2 half(text_width(sources) / 2, paper.height * 0.36);
    const FigureScene scene{&surface, fitted_camera(surface, faces, {portrait_view}, half)};
    canvas.figure("The goal of this chapter: " + c.title + ".", [&] {
        canvas.shifted(Vec2(paper.width / 2, paper.height * 0.53), [&] { draw_faces(canvas, scene, faces, marked); });
    });
}

void draw_last_page(PdfCanvas& canvas, const BookletSources& sources)
{
    const PaperSize& paper = sources.layout.paper;
    draw_heading(canvas, "Finished");
    if (sources.plan.steps.empty()) {
        return;
    }
    const Step& last = sources.plan.steps.back();
    const bool hatch = last.kind == StepKind::Insert;
    const Vec2 centre(paper.width / 2, paper.height * 0.47);
    const Vec2 half(text_width(sources) / 2, paper.height * 0.29);
    canvas.figure("The finished model, hung from its top.", [&] {
        const Camera camera = model_camera(sources, sources.layout.places.back().view, half);
        const Vec2 top = centre + project(camera, hanging_point(sources.replay.surface));
        canvas.stroke({Vec2(top.x(), page_margin + 44), top}, {2.2, 0x404040, 0}); // the cord
        draw_model(canvas, sources, centre, half, sources.layout.places.back().view, hatch ? last.element : -1);
    });
    std::string words = "To hang it, lead the cord through the hole where corners meet at the top, or hook the last "
                        "elements round the lamp holder. ";
    if (hatch) {
        const std::vector<int> names =
            element_names(sources.plan, sources.replay.surface.n_faces(), static_cast<int>(sources.plan.steps.size()));
        words +=
            "The dark red element is the bulb hatch: to reach the bulb, unhook it, and afterwards hook it in again as "
            "step " +
            std::to_string(sources.plan.steps.size()) + " shows (its neighbours are";
        for (std::size_t i = 0; i < last.joins.size(); ++i) {
            words += (i == 0                       ? " "
                      : i + 1 == last.joins.size() ? " and "
                                                   : ", ") +
                     std::to_string(names[last.joins[i].to]);
        }
        words += last.joins.empty() ? " none)." : ").";
    }
    canvas.tagged("P", [&] {
        canvas.paragraph(words, Vec2(page_margin, paper.height - page_margin - 76), text_width(sources), {11}, 15);
    });
}

void draw_page_frame(PdfCanvas& canvas, const BookletSources& sources, int chapter, int first_step, int last_step,
                     int page)
{
    const PaperSize& paper = sources.layout.paper;
    const auto steps = static_cast<double>(sources.plan.steps.size());
    const double y = paper.height - page_margin;
    const double left = page_margin;
    const double width = text_width(sources) - 60;
    canvas.tagged("P", [&] {
        canvas.text(sources.layout.chapters[chapter].title, Vec2(page_margin, page_margin + 14), {14});
        canvas.text(std::to_string(page), Vec2(paper.width - page_margin, y), {10, 0x202020, Align::Right, 0});
    });
    const auto bar = [&](double from, double to, unsigned rgb) {
        canvas.stroke({Vec2(left + from * width, y - 3), Vec2(left + to * width, y - 3)}, {5, rgb, 0});
    };
    bar(0, 1, 0xE2E2E2);
    bar(0, (last_step + 1) / steps, 0xC9A25E);
    bar(first_step / steps, (last_step + 1) / steps, 0x6A4A10);
}

} // namespace rhombloom
