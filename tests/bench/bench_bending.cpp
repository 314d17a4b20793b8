// usage: bench_bending [DESIGN...]
// How true the bent elements of a preview are: each as its sheet bends (raw) and as the preview files hold it (kept).
// Without designs: the library's shapes with the default element, then odd elements.

#include <cstdio>
#include <fstream>
#include <sstream>

#include "core/building/assembly_plan.h"
#include "core/design/design_file.h"
#include "core/model/base_shapes.h"
#include "exporters/preview.h"

using namespace rhombloom;

namespace {

int missed = 0;

const char* mark(double value, double limit)
{
    missed += value > limit;
    return value > limit ? "!" : " ";
}

void print_head()
{
    std::printf("%-34s %5s | %6s %6s %6s %6s | %6s %6s %7s %6s %5s %8s %8s\n", "rim, corners, lengths", "count",
                "rim %", "len %", "p99 %", "hook %", "rim %", "len %", "corner", "modes", "err", "glb", "html");
}

void print_row(const std::string& name, const Replay& made, const Element& element)
{
    const Expected<BentSurface> raw = bent_surface(made.surface, element);
    const AssemblyPlan plan = assembly_plan(made, element, Order::Paper);
    PreviewOptions options;
    options.thumbnail_size = 64;
    const Expected<PreviewFiles> files = preview_files(made, plan, element, options);
    if (!raw || !files) {
        std::printf("%-34s refused: %s\n", name.c_str(), (raw ? files.error() : raw.error()).message.c_str());
        ++missed;
        return;
    }
    const BendingReport& r = raw->report;
    const PreviewReport& p = files->report;
    std::printf("%-34s %5zu | %6.2f%s%6.2f %6.2f %6.2f | %6.2f%s%6.2f %7.4f%s%6d %.3f%s%8zu %8zu\n", name.c_str(),
                made.surface.n_faces(), 100 * r.max_rim_distortion, mark(r.max_rim_distortion, 0.01),
                100 * r.max_length_distortion, 100 * r.p99_length_distortion, 100 * r.max_hook_distortion,
                100 * p.bending.max_rim_distortion, mark(p.bending.max_rim_distortion, 0.01),
                100 * p.bending.max_length_distortion, p.bending.max_corner_error_mm,
                mark(p.bending.max_corner_error_mm, 0.1), p.modes, p.max_position_error_mm,
                mark(p.max_position_error_mm, 0.05), p.glb_bytes, p.html_bytes);
    std::fflush(stdout);
}

std::string text_of(const char* path)
{
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

Replay placed(const std::string& shape, const Element& element)
{
    Replay made;
    made.surface = base_shape(shape, element)->surface;
    made.embedding = embed(made.surface, element);
    made.stages.push_back({"place " + shape, made.surface});
    return made;
}

void print_shapes(const std::string& label, const Element& element, const std::vector<std::string>& shapes)
{
    for (const std::string& shape : shapes) {
        print_row(shape + label, placed(shape, element), element);
    }
}

} // namespace

int main(int count, char** arguments)
{
    print_head();
    for (int k = 1; k < count; ++k) {
        const Expected<Design> design = parse_design(text_of(arguments[k]));
        const Expected<Replay> made = design.and_then([](const Design& d) { return replay(d); });
        if (!made) {
            std::printf("%s: %s\n", arguments[k], made.error().message.c_str());
            return 1;
        }
        print_row(arguments[k], *made, design->element);
    }
    if (count == 1) {
        print_shapes("", {}, base_shape_names());
        const std::vector<std::string> some = {"ball-30", "polar-5x4", "tube-6x6", "torus-12x6", "sheet-4x6"};
        print_shapes(" la 40", {40, 44.8, radians(63.435), 0.5}, some);
        print_shapes(" alpha 52", {100, 112, radians(52), 0.5}, some);
        print_shapes(" alpha 76", {100, 112, radians(76), 0.5}, some);
        print_shapes(" t 0.25", {100, 112, radians(63.435), 0.25}, some);
        print_shapes(" la 200 lb/la 1.5", {200, 300, radians(63.435), 0.8}, some);
    }
    std::printf("%d values beyond their limits: rim 1 %%, corners 0.1 mm, points 0.05 mm\n", missed);
    return missed == 0 ? 0 : 1;
}
