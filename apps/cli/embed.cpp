#include "apps/cli/commands.h"
#include "apps/cli/console.h"
#include "core/text.h"
#include "exporters/save.h"
#include "exporters/surface_file.h"

namespace rhombloom::cli {

namespace {

Expected<int> run_embed(const std::string& design_path, const std::string& output)
{
    const auto design = load_design(design_path);
    if (!design) {
        return tl::make_unexpected(design.error());
    }
    Progress progress;
    const auto replayed = replay_design(design_path, *design, progress);
    if (!replayed) {
        return tl::make_unexpected(replayed.error());
    }
    const auto bytes = surface_file(output, replayed->surface, design->element, replayed->embedding);
    if (!bytes) {
        return tl::make_unexpected(bytes.error());
    }
    if (auto ok = spare_input(design_path, output); !ok) {
        return tl::make_unexpected(ok.error());
    }
    if (auto ok = save_file(output, *bytes); !ok) {
        return tl::make_unexpected(ok.error());
    }
    const EmbedReport& report = replayed->embedding;
    return print(std::to_string(replayed->surface.n_faces()) + " elements, energy " + to_fixed(report.energy, 4) +
                 " mm, largest stretch " + to_fixed(100 * report.max_stretch, 3) + " %, " +
                 (report.converged ? "converged after " : "NOT converged after ") + std::to_string(report.iterations) +
                 " iterations; wrote " + output + "\n")
        .map([&] { return report.converged ? 0 : 1; });
}

} // namespace

void add_embed(CLI::App& app, Run& run)
{
    auto* command = app.add_subcommand("embed", "Write the shape that the elements settle in: json, obj, off or ply.");
    command->footer("Example: rhombloom embed examples/ball-30.json -o ball.obj");
    auto design = std::make_shared<std::string>();
    auto output = std::make_shared<std::string>();
    command->add_option("DESIGN", *design, "design file")->required();
    command->add_option("-o,--output", *output, "file to write: .json, .obj, .off or .ply")->required();
    command->callback([&run, design, output] { run = [design, output] { return run_embed(*design, *output); }; });
}

} // namespace rhombloom::cli
