#include "exporters/booklet_pages.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace rhombloom {

void draw_heading(PdfCanvas& canvas, const BookletSources& sources, const std::string& text)
{
    const double size = canvas.fitting_size(text, sources.layout.paper.width - 2 * page_margin, 24);
    canvas.tagged("H1", [&] {
        canvas.text(text, Vec2(page_margin, page_margin + 24), {size, 0x000000, Align::Left, 0});
    });
}

namespace {

constexpr int portrait_view = 1; // a little from the side, a little from above
constexpr int most_hooked = 300; // elements of a model that is drawn with its hooks

//! As large as leaves the picture its room.
void draw_title(PdfCanvas& canvas, const std::string& title, double width)
{
    constexpr double room = 90, leading = 7.0 / 6;
    double size = 36;
    while (size > 12 && static_cast<double>(canvas.lines(title, width, size).size()) * leading * size > room) {
        size -= 2;
    }
    canvas.tagged("H1",
                  [&] { canvas.paragraph(title, Vec2(page_margin, page_margin + 40), width, {size}, leading * size); });
}

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

} // namespace

std::string chapter_destination(int chapter)
{
    return "chapter-" + std::to_string(chapter + 1);
}

Camera model_camera(const BookletSources& sources, int view, const Vec2& half)
{
    return fitted_camera(sources.replay.surface, all_faces(sources.replay.surface), {view}, 0.97 * half);
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
    draw_title(canvas, title, text_width(sources));
    canvas.figure("The finished model: " + title + ".", [&] {
        draw_model(canvas, sources, Vec2(paper.width / 2, paper.height * 0.5),
                   Vec2(text_width(sources) / 2, paper.height * 0.32), portrait_view);
    });
    std::string facts = plural(static_cast<int>(sources.replay.surface.n_faces()), "element");
    facts += options.sheets > 0 ? "   \u00B7   " + plural(options.sheets, "sheet") : "";
    facts += "   \u00B7   " + duration(score.minutes, 5);
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
    draw_heading(canvas, sources, std::to_string(chapter + 1) + "  " + c.title);
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

void draw_page_frame(PdfCanvas& canvas, const BookletSources& sources, int chapter, int first_step, int last_step,
                     int page)
{
    const PaperSize& paper = sources.layout.paper;
    const auto steps = static_cast<double>(sources.plan.steps.size());
    const double y = paper.height - page_margin;
    const double left = page_margin;
    const double width = text_width(sources) - 60;
    canvas.tagged("P", [&] {
        const std::string& title = sources.layout.chapters[chapter].title;
        canvas.text(title, Vec2(page_margin, page_margin + 14), {canvas.fitting_size(title, text_width(sources), 14)});
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
