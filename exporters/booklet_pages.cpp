#include "exporters/booklet_pages.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace rhombloom {

namespace {

constexpr int portrait_view = 1; // a little from the side, a little from above

double text_width(const BookletSources& s)
{
    return s.layout.paper.width - 2 * page_margin;
}

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

void heading(PdfCanvas& canvas, const std::string& text)
{
    canvas.tagged("H1", [&] {
        canvas.text(text, Vec2(page_margin, page_margin + 24), {24, 0x000000, Align::Left, 0});
    });
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
void draw_faces(PdfCanvas& canvas, const Scene& scene, const std::vector<Face>& faces, const std::vector<char>& marked)
{
    for (const Face f : painter_order(scene, faces)) {
        draw_element(canvas, scene, f, !marked.empty() && marked[f.idx()] ? Paint::Chapter : Paint::Built);
    }
}

} // namespace

std::string chapter_destination(int chapter)
{
    return "chapter-" + std::to_string(chapter + 1);
}

std::string step_destination(int step)
{
    return "step-" + std::to_string(step + 1);
}

void draw_model(PdfCanvas& canvas, const BookletSources& sources, const Vec2& centre, const Vec2& half)
{
    const Surface& surface = sources.replay.surface;
    Scene scene{&surface, fitted_camera(surface, all_faces(surface), {portrait_view}, half)};
    canvas.shifted(centre, [&] { draw_faces(canvas, scene, all_faces(surface), {}); });
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
                   Vec2(text_width(sources) / 2, paper.height * 0.32));
    });
    std::string facts = plural(static_cast<int>(sources.replay.surface.n_faces()), "element");
    facts += options.sheets > 0 ? "   \u00B7   " + plural(options.sheets, "sheet") : "";
    facts += "   \u00B7   " + duration(score.minutes);
    canvas.tagged("P", [&] {
        canvas.text(facts, Vec2(page_margin, paper.height - page_margin - 14), {15, 0x202020, Align::Left, 0});
    });
}

void draw_how_to_read(PdfCanvas& canvas, const BookletSources& sources)
{
    heading(canvas, "How to read this booklet");
    const char* rules[] = {
        "Every picture shows the model as it stands, seen from outside. The red element is the next one.",
        "Thick black lines are the sides that are joined in the step. The arrow shows where the element comes from.",
        "Dots mean flipped: turn the element over before you hook it in. No dots: the front looks outward.",
        "Blue-grey elements are seen from inside, through an opening. Thin grey lines show what is still missing.",
        "The view stays the same as long as it can. When it changes, the turn is written beside the step's number.",
        "The numbers on the elements are the steps in which they were put in.",
        "Some steps take an element out again: a white element with a cross."};
    double y = page_margin + 60;
    for (const char* rule : rules) {
        canvas.tagged("P",
                      [&] { y = canvas.paragraph(rule, Vec2(page_margin, y), text_width(sources), {11}, 15) + 6; });
    }
    canvas.tagged("H2", [&] { canvas.text("Chapters", Vec2(page_margin, y + 24), {15}); });
    y += 46;
    for (std::size_t c = 0; c < sources.layout.chapters.size(); ++c) {
        const Chapter& chapter = sources.layout.chapters[c];
        const std::string line = chapter.title + ", steps " + std::to_string(chapter.first + 1) + " to " +
                                 std::to_string(chapter.first + chapter.count) + ", page " +
                                 std::to_string(chapter.page);
        canvas.link(chapter_destination(static_cast<int>(c)), [&] {
            canvas.text(line, Vec2(page_margin, y), {11, 0x0050A0, Align::Left, 0});
        });
        y += 16;
    }
}

void draw_parts(PdfCanvas& canvas, const BookletSources& sources, const BookletOptions& options)
{
    heading(canvas, "Parts and tools");
    const Scorecard& score = sources.plan.scorecard;
    const auto final_count = static_cast<int>(sources.replay.surface.n_faces());
    std::vector<std::string> lines = {
        plural(score.parts_needed, "element") + ", all of the same shape" +
            (score.parts_needed > final_count
                 ? " (the finished model has " + std::to_string(final_count) + "; the others are taken out again)"
                 : ""),
        "Material: " + (options.material.empty() ? "sheet" : options.material) + ", " +
            to_fixed(sources.element.thickness, 2) + " mm thick",
        "A table, good light, and " + duration(score.minutes),
        "Small clips or tape help to hold the rim while you work"};
    double y = page_margin + 60;
    for (const std::string& line : lines) {
        canvas.tagged("P", [&] {
            y = canvas.paragraph("\u2022  " + line, Vec2(page_margin, y), text_width(sources), {11}, 15) + 4;
        });
    }
}

void draw_joint(PdfCanvas& canvas, const BookletSources& sources)
{
    heading(canvas, "How one joint is hooked");
    const char* rules[] = {
        "Each element has two long sides, without hooks, and two short sides with a hook at each end.",
        "A long side always meets a short side. The hooks lie over the long side, on the outside of the model.",
        "Slide the long side under the first hook, bend it a little, slide it under the second hook, let go."};
    double y = page_margin + 60;
    for (const char* rule : rules) {
        canvas.tagged("P",
                      [&] { y = canvas.paragraph(rule, Vec2(page_margin, y), text_width(sources), {11}, 15) + 6; });
    }
}

void draw_chapter(PdfCanvas& canvas, const BookletSources& sources, int chapter)
{
    const Chapter& c = sources.layout.chapters[chapter];
    const PaperSize& paper = sources.layout.paper;
    canvas.destination(chapter_destination(chapter));
    heading(canvas, c.title);
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
    const Scene scene{&surface, fitted_camera(surface, faces, {portrait_view}, half)};
    canvas.figure("The goal of this chapter: " + c.title + ".", [&] {
        canvas.shifted(Vec2(paper.width / 2, paper.height * 0.53), [&] { draw_faces(canvas, scene, faces, marked); });
    });
}

void draw_last_page(PdfCanvas& canvas, const BookletSources& sources)
{
    const PaperSize& paper = sources.layout.paper;
    heading(canvas, "Finished");
    canvas.figure("The finished model.", [&] {
        draw_model(canvas, sources, Vec2(paper.width / 2, paper.height * 0.42),
                   Vec2(text_width(sources) / 2, paper.height * 0.3));
    });
    if (sources.plan.steps.empty()) {
        return;
    }
    const std::string hatch = std::to_string(sources.plan.steps.size());
    canvas.tagged("P", [&] {
        canvas.paragraph("Bulb hatch: to reach the bulb later, unhook the element of the last step, number " + hatch +
                             ", and hook it in again as its picture shows.",
                         Vec2(page_margin, paper.height - page_margin - 50), text_width(sources), {11}, 15);
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
