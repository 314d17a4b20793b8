// usage: bench_preview DESIGN
// Seconds of the best of five runs, as one line of JSON, inside this process: `encode` from the bent elements in memory
// to the bytes of preview.glb; `check` reads those bytes back and measures the error, which no rival does; `all` from
// the embedded surface to all preview files (bending, modes, check, page, picture).

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>

#include "core/building/assembly_plan.h"
#include "core/design/design_file.h"
#include "exporters/preview_model.h"

using namespace rhombloom;

namespace {

double best_of(const std::function<void()>& work)
{
    double best = 1e9;
    for (int run = 0; run < 5; ++run) {
        const auto start = std::chrono::steady_clock::now();
        work();
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
}

std::string text_of(const char* path)
{
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

struct Seconds
{
    double encode = 0;
    double check = 0;
};

//! The scene in the encoding that preview_files() chose; modes are checked while they are written.
Seconds encoding_seconds(const Replay& made, const AssemblyPlan& plan, const Element& element, PreviewEncoding encoding)
{
    Expected<BentSurface> bent = bent_surface(made.surface, element);
    PreviewModel model;
    model.bent = std::move(*bent);
    model.labels = element_labels(made.surface, plan);
    model.components = made.surface.components;
    model.thickness = element.thickness;
    const PreviewOptions options;
    Seconds seconds;
    if (encoding == PreviewEncoding::BendingModes) {
        seconds.encode = best_of([&] {
            model.modes = bending_modes(model.bent, 0.2 * options.tolerance_mm, 40);
            expects(modes_glb(model, options).has_value(), "bench_preview: encoded");
        });
        return seconds;
    }
    Expected<MergedPreview> merged;
    seconds.encode = best_of([&] { merged = encoded_merged(model, options); });
    seconds.check = best_of([&] {
        expects(decoded_error_mm(merged->parts).value_or(1) <= options.tolerance_mm, "bench_preview: as true as asked");
    });
    return seconds;
}

} // namespace

int main(int count, char** arguments)
{
    if (count != 2) {
        std::fprintf(stderr, "usage: bench_preview DESIGN\n");
        return 2;
    }
    const Expected<Design> design = parse_design(text_of(arguments[1]));
    const Expected<Replay> made = design.and_then([](const Design& d) { return replay(d); });
    if (!made) {
        std::fprintf(stderr, "%s\n", made.error().message.c_str());
        return 1;
    }
    const AssemblyPlan plan = assembly_plan(*made, design->element, Order::Paper);
    PreviewEncoding encoding = PreviewEncoding::Merged;
    const double all = best_of([&] {
        const Expected<PreviewFiles> files = preview_files(*made, plan, design->element);
        expects(files.has_value(), "bench_preview: files");
        encoding = files->report.encoding;
    });
    const Seconds seconds = encoding_seconds(*made, plan, design->element, encoding);
    std::printf("{\"encode\": %.4f, \"check\": %.4f, \"all\": %.3f}\n", seconds.encode, seconds.check, all);
    return 0;
}
