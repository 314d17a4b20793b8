#pragma once

#include <string>
#include <vector>

#include "exporters/paper.h"
#include "exporters/pdf_font.h"
#include "exporters/pdf_page.h"

namespace rhombloom {

struct DocumentInfo
{
    std::string title;
    std::string language = "en";
};

//! \brief Put pages together to a PDF/A-1b: tagged, with bookmarks and page labels, packed tightly.
//! \details Refuses when a page has a problem.
Expected<std::string> pdf_document(const PdfFont& font, std::vector<PdfPage> pages, const PaperSize& paper,
                                   const DocumentInfo& info);

//! \brief Two pages of such a document side by side on each sheet's side, in the order for folding a stack of sheets
//! (saddle stitch): print on both sides, flip on the short edge, fold. Blank pages fill up to a multiple of four.
std::string impose_pdf(const std::string& bytes, Paper paper, const std::string& title);

//! \brief A small sRGB profile (ICC version 2, with the standard's tone curve).
std::string srgb_profile();

} // namespace rhombloom
