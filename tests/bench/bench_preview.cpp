// usage: bench_preview DESIGN
// Seconds of the best of three runs, as one line of JSON: `encode` from the bent elements to preview.glb as the program
// stores it, decoded and checked; `all` from the embedded surface to all preview files (bending, modes, page, picture).

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

double best_of_three(const std::function<void()>& work)
{
    double best = 1e9;
    for (int run = 0; run < 3; ++run) {
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

//! The scene in the encoding that preview_files() chose.
double encoding_seconds(const Replay& made, const AssemblyPlan& plan, const Element& element, PreviewEncoding encoding)
{
    Expected<BentSurface> bent = bent_surface(made.surface, element);
    PreviewModel model;
    model.bent = std::move(*bent);
    model.labels = element_labels(made.surface, plan);
    model.components = made.surface.components;
    model.thickness = element.thickness;
    const PreviewOptions options;
    if (encoding == PreviewEncoding::Merged) {
        return best_of_three([&] { expects(merged_glb(model, options).has_value(), "bench_preview: encoded"); });
    }
    return best_of_three([&] {
        model.modes = bending_modes(model.bent, 0.2 * options.tolerance_mm, 40);
        expects(modes_glb(model, options).has_value(), "bench_preview: encoded");
    });
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
    const double all = best_of_three([&] {
        const Expected<PreviewFiles> files = preview_files(*made, plan, design->element);
        expects(files.has_value(), "bench_preview: files");
        encoding = files->report.encoding;
    });
    std::printf("{\"encode\": %.3f, \"all\": %.3f}\n", encoding_seconds(*made, plan, design->element, encoding), all);
    return 0;
}
