#include <filesystem>

#include "apps/cli/commands.h"
#include "apps/cli/console.h"
#include "core/design/design_file.h"
#include "core/design/mesh_import/mesh_import.h"
#include "core/text.h"
#include "exporters/mesh_reader.h"
#include "exporters/save.h"

namespace rhombloom::cli {

namespace {

struct ImportArguments
{
    std::string mesh;
    std::string output;
    ImportOptions import;
};

Expected<int> run_import(const ImportArguments& arguments)
{
    Progress progress;
    constexpr std::size_t max_bytes = 2'000'000'000;
    const auto bytes = load_file(arguments.mesh, max_bytes);
    if (!bytes) {
        return tl::make_unexpected(bytes.error());
    }
    const auto file = read_mesh(arguments.mesh, *bytes);
    if (!file) {
        return refuse(arguments.mesh + ": " + file.error().message);
    }
    const auto made = import_mesh(file->mesh, arguments.import);
    if (!made) {
        return refuse(arguments.mesh + ": " + made.error().message);
    }
    Design design;
    design.title = std::filesystem::path(arguments.mesh).stem().string();
    design.element = made->element;
    design.operations = {made->operation};
    if (auto ok = save_file(arguments.output, write_design(design)); !ok) {
        return tl::make_unexpected(ok.error());
    }
    const ImportReport& r = made->report;
    return print(std::to_string(r.elements) + " elements, distance rms " +
                 to_fixed(r.distance.to_target.rms / r.la, 3) + " / " + to_fixed(r.distance.from_target.rms / r.la, 3) +
                 " la, max " + to_fixed(r.distance.to_target.max / r.la, 2) + " / " +
                 to_fixed(r.distance.from_target.max / r.la, 2) + ", stretch " +
                 to_fixed(100 * r.embedding.max_stretch, 2) + " %, converged " + std::to_string(r.embedding.converged) +
                 " its " + std::to_string(r.embedding.iterations) + "\n")
        .map([] { return 0; });
}

} // namespace

void add_import(CLI::App& app, Run& run)
{
    auto* command = app.add_subcommand("import", "Make a design from a mesh: OBJ, PLY, STL, OFF or GLB.");
    command->footer("Example: rhombloom import vase.obj -o vase.json --elements 600");
    auto arguments = std::make_shared<ImportArguments>();
    command->add_option("MESH", arguments->mesh, "file with the target")->required();
    command->add_option("-o,--output", arguments->output, "design file to write")->required();
    command->add_option("--elements", arguments->import.size.elements, "how many elements to use");
    command->callback([&run, arguments] { run = [arguments] { return run_import(*arguments); }; });
}

} // namespace rhombloom::cli
