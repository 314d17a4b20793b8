#pragma once

#include <string>

#include "core/expected.h"
#include "exporters/cut_sheet.h"

namespace rhombloom {

//! \brief The piece at full size to print, trace and cut by hand: a PDF 1.5 of A4 or Letter pages.
//! \details As many copies as one page holds beside a 50 mm check square; a piece that is larger than the page comes
//! on tiles that overlap and share registration marks, behind a page with the square and the plan of the tiles.
//! All lettering is drawn as strokes, so that no font is needed. Without dates: the same piece gives the same bytes.
Expected<std::string> template_pdf(const Path& outline, Paper paper);

} // namespace rhombloom
