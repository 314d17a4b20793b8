#pragma once

#include "exporters/booklet_steps.h"
#include "exporters/words.h"

namespace rhombloom {

// The pages of a booklet that are not steps. Each draws one page.

void draw_cover(PdfCanvas& canvas, const BookletSources& sources, const std::string& title,
                const BookletOptions& options);
void draw_how_to_read(PdfCanvas& canvas, const BookletSources& sources);
void draw_parts(PdfCanvas& canvas, const BookletSources& sources, const BookletOptions& options);
void draw_joint(PdfCanvas& canvas, const BookletSources& sources);
void draw_chapter(PdfCanvas& canvas, const BookletSources& sources, int chapter);
void draw_last_page(PdfCanvas& canvas, const BookletSources& sources);

void draw_heading(PdfCanvas& canvas, const BookletSources& sources, const std::string& text);

//! \brief Number of the page, chapter and progress bar at the foot of a step page.
void draw_page_frame(PdfCanvas& canvas, const BookletSources& sources, int chapter, int first_step, int last_step,
                     int page);

//! \brief The camera that draw_model takes.
Camera model_camera(const BookletSources& sources, int view, const Vec2& half);

//! \brief The finished model, as large as fits about \p centre, from viewpoint \p view; with hooks when it has not too
//! many elements to see them.
//! \param marked an element to show in the colour of the next one; -1: none
Camera draw_model(PdfCanvas& canvas, const BookletSources& sources, const Vec2& centre, const Vec2& half, int view,
                  int marked = -1);

//! \brief "chapter-2": where the link to a chapter leads.
std::string chapter_destination(int chapter);

} // namespace rhombloom
