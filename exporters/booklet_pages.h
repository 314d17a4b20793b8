#pragma once

#include "exporters/booklet_steps.h"

namespace rhombloom {

// The pages of a booklet that are not steps. Each draws one page, between start_page and finish_page.

void draw_cover(PdfCanvas& canvas, const BookletSources& sources, const std::string& title,
                const BookletOptions& options);
void draw_how_to_read(PdfCanvas& canvas, const BookletSources& sources);
void draw_parts(PdfCanvas& canvas, const BookletSources& sources, const BookletOptions& options);
void draw_joint(PdfCanvas& canvas, const BookletSources& sources);
void draw_chapter(PdfCanvas& canvas, const BookletSources& sources, int chapter);
void draw_last_page(PdfCanvas& canvas, const BookletSources& sources);

//! \brief Number of the page, chapter and progress bar at the foot of a step page.
void draw_page_frame(PdfCanvas& canvas, const BookletSources& sources, int chapter, int first_step, int last_step,
                     int page);

//! \brief The finished model, as large as fits about \p centre.
void draw_model(PdfCanvas& canvas, const BookletSources& sources, const Vec2& centre, const Vec2& half);

//! \brief "chapter-2": where the link to a chapter leads; "step-12": to a step.
std::string chapter_destination(int chapter);
std::string step_destination(int step);

} // namespace rhombloom
