#include "exporters/booklet.h"

#include <algorithm>
#include <functional>

#include "core/form/parallel.h"
#include "exporters/booklet_pages.h"
#include "exporters/code_points.h"
#include "exporters/pdf_finish.h"
#include "exporters/plan_file.h"

namespace rhombloom {

namespace {

const std::string font_file = std::string(RHOMBLOOM_TEMPLATES) + "/fonts/DejaVuSansCondensed.ttf";

//! A page to be drawn.
struct Sheet
{
    std::string label;
    int section = -1;
    std::function<void(PdfCanvas&)> draw;
};

//! One booklet being written.
struct Writer
{
    const BookletSources& sources;
    const BookletOptions& options;
    std::string title;
    const StepPictures& pictures;
    std::vector<Sheet> sheets = {};

    void add(int section, std::function<void(PdfCanvas&)> draw)
    {
        const std::size_t number = sheets.size() + 1;
        sheets.push_back({number == 1 ? "Cover" : std::to_string(number), section, std::move(draw)});
    }

    void add_steps(int chapter, int first, int end)
    {
        add(chapter, [this, chapter, first, end](PdfCanvas& canvas) {
            draw_page_frame(canvas, sources, chapter, first, end - 1, sources.layout.places[first].page);
            for (int k = first; k < end; ++k) {
                canvas.bookmark(1, "Step " + std::to_string(k + 1), sources.layout.places[k].box.min.y());
            }
            pictures.draw(canvas, first, end);
        });
    }

    void add_all()
    {
        add(-1, [this](PdfCanvas& canvas) { draw_cover(canvas, sources, title, options); });
        add(-1, [this](PdfCanvas& canvas) { draw_how_to_read(canvas, sources); });
        add(-1, [this](PdfCanvas& canvas) { draw_parts(canvas, sources, options); });
        add(-1, [this](PdfCanvas& canvas) { draw_joint(canvas, sources); });
        for (int index = 0; index < static_cast<int>(sources.layout.chapters.size()); ++index) {
            const Chapter& c = sources.layout.chapters[index];
            add(index, [this, index](PdfCanvas& canvas) { draw_chapter(canvas, sources, index); });
            const int cells = c.rows * c.columns;
            for (int first = c.first; first < c.first + c.count; first += cells) {
                add_steps(index, first, std::min(first + cells, c.first + c.count));
            }
        }
        add(-1, [this](PdfCanvas& canvas) { draw_last_page(canvas, sources); });
    }

    //! Pages know nothing of each other.
    std::vector<PdfPage> drawn(const PdfFont& font) const
    {
        std::vector<PdfPage> pages(sheets.size());
        parallel_tasks(default_threads(), static_cast<int>(sheets.size()), [&](int i) {
            PdfCanvas canvas(font);
            sheets[i].draw(canvas);
            pages[i] = canvas.take();
            pages[i].label = sheets[i].label;
            pages[i].section = sheets[i].section;
        });
        return pages;
    }
};

std::string booklet_title(const Design& design, const BookletOptions& options)
{
    if (!options.title.empty()) {
        return options.title;
    }
    return design.title.empty() ? "Puzzle lamp" : design.title;
}

std::optional<char32_t> first_illegible(const PdfFont& font, const std::string& utf8)
{
    const std::vector<char32_t> letters = code_points(utf8);
    const auto found = std::find_if(letters.begin(), letters.end(), [&](char32_t c) { return !font.writes(c); });
    return found == letters.end() ? std::nullopt : std::optional(*found);
}

//! The openings whose purpose can be written: it is free text, and no reason to have no booklet.
std::vector<NamedOpening> legible_openings(const PdfFont& font, const Design& design, const Replay& replay)
{
    std::vector<NamedOpening> openings = named_openings(design, replay);
    std::erase_if(openings,
                  [&](const NamedOpening& opening) { return first_illegible(font, opening.purpose).has_value(); });
    return openings;
}

//! The name that an operation gives to a part; empty when it gives none.
std::string given_name(const Operation& operation)
{
    const auto name = [](const auto& o) -> std::string {
        if constexpr (requires { o.id; }) {
            return o.id;
        }
        return "";
    };
    return std::visit(name, operation);
}

Expected<void> check_legible(const PdfFont& font, const std::string& path, const std::string& text)
{
    if (const auto c = first_illegible(font, text)) {
        return refuse(path + " has the character U+" + hexadecimal(*c) +
                      ", which the booklet cannot write: use Latin, Greek or Cyrillic letters");
    }
    return {};
}

} // namespace

Expected<void> check_booklet_names(const Design& design)
{
    const auto font = PdfFont::load(font_file);
    if (!font) {
        return tl::make_unexpected(font.error());
    }
    auto ok = check_legible(**font, "$.title", design.title);
    for (std::size_t i = 0; ok && i < design.operations.size(); ++i) {
        ok = check_legible(**font, "$.operations[" + std::to_string(i) + "].id", given_name(design.operations[i]));
    }
    return ok;
}

Expected<BookletFiles> booklet_files(const Design& design, const Replay& replay, const AssemblyPlan& plan,
                                     const BookletOptions& options)
{
    const BookletLayout layout = booklet_layout(replay, plan, options);
    const auto font = PdfFont::load(font_file);
    if (!font) {
        return tl::make_unexpected(font.error());
    }
    const BookletSources sources{
        replay, design.element, plan, layout, piece_contour(design.element), legible_openings(**font, design, replay)};
    const StepPictures pictures(**font, sources);
    Writer writer{sources, options, booklet_title(design, options), pictures};
    writer.add_all();
    const Expected<std::string> pdf = pdf_document(**font, writer.drawn(**font), layout.paper, {writer.title, "en"});
    if (!pdf) {
        return tl::make_unexpected(pdf.error());
    }
    BookletFiles result;
    result.files["booklet-imposed.pdf"] = impose_pdf(*pdf, options.paper, writer.title);
    result.files["booklet.pdf"] = *pdf;
    result.files["plan.json"] = plan_json(replay, design.element, plan, layout);
    const auto insets = std::count_if(layout.places.begin(), layout.places.end(),
                                      [](const StepPlace& place) { return place.inset.has_value(); });
    result.report = {layout.last_page, static_cast<int>(layout.chapters.size()), plan.scorecard.view_turns,
                     static_cast<int>(insets)};
    return result;
}

} // namespace rhombloom
