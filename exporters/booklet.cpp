#include "exporters/booklet.h"

#include "exporters/booklet_pages.h"
#include "exporters/pdf_finish.h"
#include "exporters/plan_file.h"

namespace rhombloom {

namespace {

const std::string font_file = std::string(RHOMBLOOM_TEMPLATES) + "/fonts/DejaVuSansCondensed.ttf";

//! One booklet being written.
struct Writer
{
    PdfCanvas& canvas;
    const BookletSources& sources;
    const BookletOptions& options;
    std::string title;
    int insets = 0;

    template <class Draw>
    void page(const std::string& label, const Draw& draw) const
    {
        canvas.start_page(label);
        draw();
        canvas.finish_page();
    }

    void front() const
    {
        page("Cover", [&] { draw_cover(canvas, sources, title, options); });
        page("2", [&] { draw_how_to_read(canvas, sources); });
        page("3", [&] { draw_parts(canvas, sources, options); });
        page("4", [&] { draw_joint(canvas, sources); });
    }

    void chapter(int index, StepDrawer& drawer) const
    {
        const Chapter& c = sources.layout.chapters[index];
        int parent = 0;
        page(std::to_string(c.page), [&] {
            draw_chapter(canvas, sources, index);
            parent = canvas.bookmark(0, c.title, chapter_destination(index));
        });
        const int cells = c.rows * c.columns;
        for (int first = 0; first < c.count; first += cells) {
            const int from = c.first + first;
            const int to = std::min(from + cells, c.first + c.count);
            const int number = sources.layout.places[from].page;
            page(std::to_string(number), [&] {
                draw_page_frame(canvas, sources, index, from, to - 1, number);
                for (int k = from; k < to; ++k) {
                    canvas.destination(step_destination(k));
                    canvas.bookmark(parent, "Step " + std::to_string(k + 1), step_destination(k));
                    canvas.tagged("Sect", [&] { drawer.draw(k); });
                }
            });
        }
    }

    void all()
    {
        StepDrawer drawer(canvas, sources);
        canvas.tagged("Document", [&] {
            front();
            for (int c = 0; c < static_cast<int>(sources.layout.chapters.size()); ++c) {
                canvas.tagged("Sect", [&] { chapter(c, drawer); });
            }
            page(std::to_string(sources.layout.last_page), [&] { draw_last_page(canvas, sources); });
        });
        insets = drawer.insets();
    }
};

std::string booklet_title(const Design& design, const BookletOptions& options)
{
    if (!options.title.empty()) {
        return options.title;
    }
    return design.title.empty() ? "Puzzle lamp" : design.title;
}

} // namespace

Expected<BookletFiles> booklet_files(const Design& design, const Replay& replay, const AssemblyPlan& plan,
                                     const BookletOptions& options)
{
    const BookletLayout layout = booklet_layout(replay, plan, options);
    const BookletSources sources{replay, design.element, plan, layout, piece_contour(design.element)};
    PdfCanvas canvas(layout.paper.width, layout.paper.height, font_file);
    Writer writer{canvas, sources, options, booklet_title(design, options)};
    writer.all();
    const Expected<std::string> drawn = canvas.finish();
    if (!drawn) {
        return tl::make_unexpected(drawn.error());
    }
    BookletFiles result;
    const std::string pdf = finish_pdf(*drawn, {writer.title, "en", canvas.alternatives()});
    result.files["booklet-imposed.pdf"] = impose_pdf(pdf, options.paper, writer.title);
    result.files["booklet.pdf"] = pdf;
    result.files["plan.json"] = plan_json(replay, design.element, plan, layout);
    result.report = {layout.last_page, static_cast<int>(layout.chapters.size()), plan.scorecard.view_turns,
                     writer.insets};
    return result;
}

} // namespace rhombloom
