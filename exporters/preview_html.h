#pragma once

#include "exporters/preview_model.h"

namespace rhombloom {

//! \brief What the page plays beyond the finished model.
struct PreviewSteps
{
    std::vector<Step> steps;
    std::vector<BentElement> temporary;         //!< built and taken out again, numbered after the last element
    std::vector<std::array<int, 4>> neighbours; //!< of every element, side by side; -1: open
};

//! \brief The steps of \p plan with the shapes of its temporary elements, bent in the stage where they exist.
Expected<PreviewSteps> preview_steps(const Replay& replay, const AssemblyPlan& plan, const Element& element);

struct PreviewPage
{
    std::string html;
    double max_error_mm = 0; //!< of the points that the page computes
};

//! \brief One file that opens offline: the viewer (templates/viewer.*) with the model packed into it.
//! \details The packed model is zlib-compressed and base64-encoded: 4 bytes with the length of a JSON header, the
//! header, then whole numbers in arrays whose lowest bytes come first, then all second bytes and so on.
//! Its content security policy allows nothing but the page's own script and style, by their hashes.
Expected<PreviewPage> preview_page(const PreviewModel& model, const PreviewSteps& steps, const Element& element,
                                   const PreviewOptions& options);

} // namespace rhombloom
