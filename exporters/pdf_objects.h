#pragma once

#include <string>
#include <vector>

#include "exporters/pdf_finish.h"

class QPDF;

namespace rhombloom {

// What the writers of PDF files share.

//! \brief Title, dates, XMP, the sRGB output intent, language: what PDF/A-1b asks of a document.
void describe_document(QPDF& pdf, const DocumentInfo& info);

//! \brief The bytes of a document whose streams are packed already.
std::string written(QPDF& pdf);

//! \brief Each text packed for /FlateDecode, as tightly as can be; the same bytes on any number of threads.
std::vector<std::string> deflated(const std::vector<std::string>& texts);

} // namespace rhombloom
