#include "exporters/preview.h"

#include <cmath>

#include "core/text.h"
#include "exporters/preview_html.h"
#include "exporters/preview_model.h"

namespace rhombloom {

namespace {

Expected<void> check(const PreviewOptions& options)
{
    if (!(options.tolerance_mm >= 0.001 && options.tolerance_mm <= 5)) {
        return refuse("the preview's tolerance is " + to_text(options.tolerance_mm) +
                      " mm: expected a number from 0.001 to 5 mm");
    }
    return {};
}

std::string element_name(std::size_t face)
{
    const std::string number = std::to_string(face + 1);
    return "E" + std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number;
}

PictureOptions thumbnail_options(const PreviewOptions& options)
{
    PictureOptions picture;
    picture.width = picture.height = options.thumbnail_size;
    picture.background = options.background;
    picture.lamp = options.lamp;
    return picture;
}

constexpr int most_modes = 40;

//! The smaller of the two encodings that keep the tolerance. Merging costs about 1600 bytes per element: it is only
//! tried where the modes come near that.
Expected<CompressedPreview> smallest_glb(const PreviewModel& model, const PreviewOptions& options,
                                         PreviewReport& report)
{
    const std::size_t merged_guess = 1400 * model.labels.size();
    Expected<CompressedPreview> best = refuse("no bending modes");
    // How much of the tolerance the left-out modes may take; the rest is for rounding.
    for (const double share : {0.6, 0.3}) {
        best = modes_glb(model, bending_modes(model.bent, share * options.tolerance_mm, most_modes), options);
        if (best && best->max_error_mm <= options.tolerance_mm) {
            break;
        }
    }
    report.encoding = PreviewEncoding::BendingModes;
    if (!best || best->max_error_mm > options.tolerance_mm || best->bytes.size() > merged_guess) {
        Expected<CompressedPreview> merged = merged_glb(model, options);
        const bool good = best && best->max_error_mm <= options.tolerance_mm;
        if (!merged || !good || merged->bytes.size() < best->bytes.size()) {
            report.encoding = PreviewEncoding::Merged;
            return merged;
        }
    }
    report.modes = best->modes;
    return best;
}

} // namespace

std::vector<ElementLabel> element_labels(const Surface& surface, const AssemblyPlan& plan)
{
    std::vector<ElementLabel> labels;
    for (const Face f : surface.faces()) {
        labels.push_back({element_name(f.idx()), 0, surface.data(f).facing, surface.data(f).component});
    }
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const Step& step = plan.steps[i];
        if (step.kind == StepKind::Insert && step.element >= 0 && step.element < static_cast<int>(labels.size())) {
            labels[step.element].step = static_cast<int>(i) + 1;
        }
    }
    return labels;
}

nlohmann::ordered_json label_extras(const PreviewModel& model, const ElementLabel& label)
{
    return {{"step", label.step},
            {"side", label.facing == Facing::Front ? "front" : "back"},
            {"component", model.components[label.component]}};
}

Expected<PreviewFiles> preview_files(const Replay& replay, const AssemblyPlan& plan, const Element& element,
                                     const PreviewOptions& options)
{
    if (auto ok = check(options); !ok) {
        return tl::make_unexpected(ok.error());
    }
    Expected<BentSurface> bent = bent_surface(replay.surface, element);
    if (!bent) {
        return tl::make_unexpected(bent.error());
    }
    const PreviewModel model{std::move(*bent), element_labels(replay.surface, plan), replay.surface.components,
                             element.thickness, options.title};
    PreviewFiles result;
    const Expected<CompressedPreview> compressed = smallest_glb(model, options, result.report);
    if (!compressed) {
        return tl::make_unexpected(compressed.error());
    }
    const Expected<PreviewSteps> steps = preview_steps(replay, plan, element);
    if (!steps) {
        return tl::make_unexpected(steps.error());
    }
    Expected<PreviewPage> page = preview_page(model, *steps, element, options);
    if (!page) {
        return tl::make_unexpected(page.error());
    }
    Expected<std::string> picture = picture_png(model.bent, thumbnail_options(options));
    if (!picture) {
        return tl::make_unexpected(picture.error());
    }
    result.report.bending = model.bent.report;
    result.report.max_position_error_mm = compressed->max_error_mm;
    result.files["preview.glb"] = compressed->bytes;
    result.files["preview-plain.glb"] = plain_glb(model, options);
    result.files["preview.html"] = std::move(page->html);
    result.files["thumbnail.png"] = std::move(*picture);
    result.report.glb_bytes = result.files["preview.glb"].size();
    result.report.plain_bytes = result.files["preview-plain.glb"].size();
    result.report.html_position_error_mm = page->max_error_mm;
    result.report.html_bytes = result.files["preview.html"].size();
    result.report.thumbnail_bytes = result.files["thumbnail.png"].size();
    return result;
}

} // namespace rhombloom
