#pragma once

#include "exporters/preview_model.h"
#include "exporters/preview_steps.h"

namespace rhombloom {

struct PreviewPage
{
    std::string html;
    double max_error_mm = 0; //!< of the points that the page computes
};

//! \brief One file that opens offline: the viewer (templates/viewer.*) with the model packed into it.
//! \details Its content security policy allows nothing but the page's own script and style, by their hashes.
Expected<PreviewPage> preview_page(const PreviewModel& model, const PreviewSteps& steps, const Element& element,
                                   const PreviewOptions& options);

} // namespace rhombloom
