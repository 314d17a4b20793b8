#pragma once

#include "exporters/preview_model.h"
#include "exporters/preview_steps.h"

namespace rhombloom {

struct PackedPreview
{
    std::string data;
    double max_error_mm = 0; //!< of the points that the page computes
};

//! \brief Model and steps as the viewer reads them (templates/viewer.js).
//! \details zlib-compressed and base64-encoded: 4 bytes with the length of a JSON header, the header, then whole
//! numbers in arrays whose lowest bytes come first, then all second bytes and so on.
PackedPreview packed_preview(const PreviewModel& model, const PreviewSteps& steps, const Element& element,
                             const PreviewOptions& options);

//! \brief zlib-compressed and base64-encoded, as the page unpacks it (templates/viewer_start.js).
std::string packed_text(const std::string& bytes);

std::string base64(const std::string& bytes);

//! Whole numbers, bytes sorted by significance: what deflate compresses best.
template <class Numbers>
void append_sorted_bytes(std::string& bytes, const Numbers& values, int size)
{
    for (int b = 0; b < size; ++b) {
        for (const auto value : values) {
            bytes.push_back(static_cast<char>(static_cast<std::uint32_t>(static_cast<std::int32_t>(value)) >> (8 * b)));
        }
    }
}

} // namespace rhombloom
