#include "exporters/preview.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "core/form/parallel.h"
#include "core/text.h"
#include "exporters/bending_modes_settle.h"
#include "exporters/bent_element_report.h"
#include "exporters/comparison.h"
#include "exporters/preview_ghost.h"
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

//! \brief How many bending modes the file can pay for: a mode costs its points and a weight per element.
//! \details The budget is what people send without thinking: 65 kB for 188 elements, 150 kB for 588.
int affordable_modes(std::size_t elements, std::size_t points)
{
    const auto n = static_cast<double>(elements);
    const double budget = 25'000 + 212 * n;
    const double fixed = 9'000 + 120 * n;
    const double each = 3.6 * n + 10 * static_cast<double>(points) + 60;
    return std::clamp(static_cast<int>((budget - fixed) / each), 16, 40);
}

//! Final and temporary elements in one list.
BentSurface together(const BentSurface& bent, const PreviewSteps& steps)
{
    BentSurface all = bent;
    all.elements.insert(all.elements.end(), steps.temporary.begin(), steps.temporary.end());
    return all;
}

//! Give the elements of \p all, as the modes describe them, back to model and steps.
void part(BentSurface all, BendingModes modes, PreviewModel& model, PreviewSteps& steps)
{
    const auto count = static_cast<std::ptrdiff_t>(model.bent.elements.size());
    steps.temporary.assign(all.elements.begin() + count, all.elements.end());
    steps.temporary_poses.assign(modes.poses.begin() + count, modes.poses.end());
    all.elements.resize(model.bent.elements.size());
    modes.poses.resize(model.bent.elements.size());
    model.bent.elements = std::move(all.elements);
    model.modes = std::move(modes);
}

//! How untrue lengths became, in units of what is allowed.
double length_excess(const SettleReport& report)
{
    return report.p99_after / std::max(0.01, 1.25 * report.p99_before);
}

//! Outlines and corners hold their limits with something to spare, and lengths hardly suffer.
bool as_true(const SettleReport& report)
{
    return report.max_rim_distortion < 0.009 && report.max_corner_error_mm < 0.09 && length_excess(report) < 1;
}

//! About \p count elements spread over the surface; all when that is little more.
BentSurface spread_elements(const BentSurface& all, std::size_t count)
{
    const std::size_t size = all.elements.size();
    if (size < 2 * count) {
        return all;
    }
    BentSurface some{all.sheet, {}, {}};
    for (std::size_t k = 0; k < count; ++k) {
        some.elements.push_back(all.elements[k * size / count]);
    }
    return some;
}

struct Choice
{
    PreviewEncoding encoding = PreviewEncoding::Merged;
    double max_corner_error_mm = 0; //!< that settling leaves
};

//! \brief Settle all elements in as few modes as leave them true; nothing when they cannot.
//! \details Some elements need no more modes than all: they are asked first, at a fraction of the cost.
std::optional<double> settled_corner_error(BentSurface& all, BendingModes& modes, const Element& element,
                                           const HookParameters& hooks)
{
    constexpr double hopeless = 1.6; // measured: twice the modes leave 0.6 of the excess
    for (const int count : {24, 48}) {
        SettleReport report;
        BentSurface settled = spread_elements(all, 4 * count);
        modes = settle(settled, element, hooks, count, &report);
        if (as_true(report) && settled.elements.size() < all.elements.size()) {
            settled = all;
            modes = settle(settled, element, hooks, count, &report);
        }
        if (as_true(report)) {
            all = std::move(settled);
            return report.max_corner_error_mm;
        }
        if (length_excess(report) > hopeless) {
            break;
        }
    }
    return std::nullopt;
}

//! The modes of a page of about the same bytes per element, whatever the number of elements.
int page_modes(std::size_t elements)
{
    return std::clamp(60 + static_cast<int>(elements) / 32, 64, 80);
}

//! \brief Few modes describe regular shapes as they are. Otherwise settle all elements in few modes; when that would
//! bend outlines, corners or lengths out of true, leave the shapes and describe them as well as modes can.
Choice choose_modes(PreviewModel& model, PreviewSteps& steps, const Element& element, const HookParameters& hooks,
                    const PreviewOptions& options)
{
    const int most = affordable_modes(model.bent.elements.size(), model.bent.sheet.points.size());
    BentSurface all = together(model.bent, steps);
    BendingModes modes = bending_modes(all, 0.2 * options.tolerance_mm, most);
    if (error_mm(modes, all) < 0.2 * options.tolerance_mm) {
        part(std::move(all), std::move(modes), model, steps);
        return {PreviewEncoding::BendingModes, 0};
    }
    if (const std::optional<double> error = settled_corner_error(all, modes, element, hooks)) {
        part(std::move(all), std::move(modes), model, steps);
        return {PreviewEncoding::BendingModes, *error};
    }
    modes = bending_modes(all, 0.6 * options.tolerance_mm, page_modes(all.elements.size()));
    part(std::move(all), std::move(modes), model, steps);
    return {PreviewEncoding::Merged, 0};
}

//! Modes if they hold the tolerance, which only rounding can break; few elements may be smaller merged.
Expected<CompressedPreview> smallest_glb(const PreviewModel& model, const PreviewOptions& options,
                                         PreviewEncoding& encoding)
{
    constexpr std::size_t few = 60;
    Expected<CompressedPreview> best = refuse("no bending modes");
    if (encoding == PreviewEncoding::BendingModes) {
        best = modes_glb(model, options);
    }
    const bool good = best && best->max_error_mm <= options.tolerance_mm;
    if (!good || model.labels.size() <= few) {
        Expected<CompressedPreview> merged = merged_glb(model, options);
        if (!merged || !good || merged->bytes.size() < best->bytes.size()) {
            encoding = PreviewEncoding::Merged;
            return merged;
        }
    }
    return best;
}

//! The files' contents, each by itself.
struct WrittenPreview
{
    PreviewEncoding encoding = PreviewEncoding::Merged;
    Expected<CompressedPreview> compressed;
    Expected<PreviewPage> page;
    Expected<std::string> png;
    std::optional<Expected<std::string>> comparison; //!< with the target, when there is one
    std::string plain;
};

WrittenPreview written(const PreviewModel& model, const PreviewSteps& steps, const Element& element,
                       const PreviewOptions& options, PreviewEncoding encoding)
{
    WrittenPreview w;
    w.encoding = encoding;
    const std::array<std::function<void()>, 5> files = {
        [&] { w.compressed = smallest_glb(model, options, w.encoding); },
        [&] { w.png = picture_png(model.bent, thumbnail_options(options)); },
        [&] { w.page = preview_page(model, steps, element, options); },
        [&] { w.plain = plain_glb(model, options); },
        [&] {
            if (options.target) {
                w.comparison = comparison_png(model.bent, *options.target, thumbnail_options(options));
            }
        },
    };
    parallel_tasks(default_threads(), static_cast<int>(files.size()), [&](int k) { files[k](); });
    return w;
}

Expected<PreviewFiles> collected(WrittenPreview w, const BendingReport& bending)
{
    if (!w.compressed) {
        return tl::make_unexpected(w.compressed.error());
    }
    if (!w.page) {
        return tl::make_unexpected(w.page.error());
    }
    for (const auto* picture : {&w.png, w.comparison ? &*w.comparison : &w.png}) {
        if (!*picture) {
            return tl::make_unexpected(picture->error());
        }
    }
    PreviewFiles result;
    PreviewReport& report = result.report;
    report.bending = bending;
    report.encoding = w.encoding;
    report.modes = w.encoding == PreviewEncoding::BendingModes ? w.compressed->modes : 0;
    report.max_position_error_mm = w.compressed->max_error_mm;
    report.html_position_error_mm = w.page->max_error_mm;
    report.glb_bytes = w.compressed->bytes.size();
    report.plain_bytes = w.plain.size();
    report.html_bytes = w.page->html.size();
    report.thumbnail_bytes = w.png->size();
    result.files["preview.glb"] = std::move(w.compressed->bytes);
    result.files["preview-plain.glb"] = std::move(w.plain);
    result.files["preview.html"] = std::move(w.page->html);
    result.files["thumbnail.png"] = std::move(*w.png);
    if (w.comparison) {
        result.files["target.png"] = std::move(**w.comparison);
    }
    return result;
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
    const HookParameters hooks = options.hooks.value_or(hook_parameters(element));
    Expected<BentSurface> bent = bent_surface(replay.surface, element, hooks);
    if (!bent) {
        return tl::make_unexpected(bent.error());
    }
    Expected<PreviewSteps> steps = preview_steps(replay, plan, element, hooks);
    if (!steps) {
        return tl::make_unexpected(steps.error());
    }
    PreviewModel model{std::move(*bent),
                       {},
                       element_labels(replay.surface, plan),
                       replay.surface.components,
                       element.thickness,
                       options.title,
                       options.target ? ghost_of(*options.target) : TriangleMesh{}};
    const Choice choice = choose_modes(model, *steps, element, hooks, options);
    model.bent.report = measure_bending(model.bent, replay.surface, element, hooks);
    model.bent.report.max_corner_error_mm = std::max(model.bent.report.max_corner_error_mm, choice.max_corner_error_mm);
    return collected(written(model, *steps, element, options, choice.encoding), model.bent.report);
}

} // namespace rhombloom
