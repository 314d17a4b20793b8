#pragma once

#include <string>
#include <vector>

#include "exporters/paper.h"

namespace rhombloom {

struct DocumentInfo
{
    std::string title;
    std::string language = "en";
    std::vector<std::string> alternatives; //!< of the figures, in the order of the document
};

//! \brief Turn a drawn document into PDF/A-1b: language, alternative texts, XMP, the sRGB output intent, opening with
//! its bookmarks; and pack it tightly. No transparency may have been drawn.
std::string finish_pdf(const std::string& bytes, const DocumentInfo& info);

//! \brief Two pages side by side on each sheet's side, in the order for folding a stack of sheets (saddle stitch):
//! print on both sides, flip on the short edge, fold. Blank pages fill up to a multiple of four.
std::string impose_pdf(const std::string& bytes, Paper paper, const std::string& title);

//! \brief A small sRGB profile (ICC version 2, with the standard's tone curve).
std::string srgb_profile();

} // namespace rhombloom
