#include <filesystem>

#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/console.h"
#include "apps/cli/usage.h"
#include "core/design/design_file.h"
#include "core/design/mesh_import/mesh_import.h"
#include "core/design/mesh_import/network.h"
#include "core/model/element_stretch.h"
#include "core/text.h"
#include "exporters/comparison.h"
#include "exporters/mesh_reader.h"
#include "exporters/save.h"
#include "exporters/target_file.h"

namespace rhombloom::cli {

namespace {

struct ImportArguments
{
    std::string mesh;
    std::string output;
    std::optional<double> lb;
    std::optional<double> alpha_deg;
    std::optional<double> thickness;
    ImportSize size;
    bool json = false;
};

//! The element's proportions are the usual ones where nothing else is asked for.
Expected<Element> element(const ImportArguments& arguments)
{
    Element result;
    const double ratio = result.lb / result.la;
    result.la = arguments.size.la.value_or(result.la);
    result.lb = arguments.lb.value_or(ratio * result.la);
    result.alpha = arguments.alpha_deg ? radians(*arguments.alpha_deg) : result.alpha;
    result.thickness = arguments.thickness.value_or(result.thickness);
    if (auto ok = check(result); !ok) {
        return tl::make_unexpected(ok.error());
    }
    return result;
}

//! Where the picture of target and elements goes: vase.json, vase.png.
std::string picture_path(const std::string& design)
{
    return std::filesystem::path(design).replace_extension(".png").string();
}

std::string in_la(double mm, const ImportReport& report)
{
    return to_fixed(mm / report.la, 2) + " la (" + to_fixed(mm, 1) + " mm)";
}

//! Why the network cannot be built as it is; empty when it can.
std::string build_problem(const ImportReport& report)
{
    if (report.crosses) {
        return "elements cross each other: try more elements or a target without thin walls and narrow gaps";
    }
    if (report.embedding.converged && report.embedding.max_stretch <= usual_stretch_limit) {
        return {};
    }
    return "no network was found that can be built: an element would have to stretch by " +
           to_fixed(100 * report.embedding.max_stretch, 2) +
           " %, a sheet gives 1 %; try another number of elements or a target with gentler hollows";
}

std::string as_text(const ImportedMesh& made, const std::string& design)
{
    const ImportReport& r = made.report;
    std::string text;
    for (const std::string& repair : r.repairs) {
        text += "repaired: " + repair + "\n";
    }
    const Vec3 size = bounds(made.target).sizes();
    text += std::to_string(r.elements) + " elements of la " + to_fixed(r.la, 2) + " mm (" +
            std::to_string(r.elements_asked) + " asked for), target " + to_fixed(size.x(), 0) + " x " +
            to_fixed(size.y(), 0) + " x " + to_fixed(size.z(), 0) + " mm\n";
    text += "from the elements to the target: rms " + in_la(r.distance.to_target.rms, r) + ", largest " +
            in_la(r.distance.to_target.max, r) + "\n";
    text += "from the target to the elements: rms " + in_la(r.distance.from_target.rms, r) + ", largest " +
            in_la(r.distance.from_target.max, r) + "\n";
    text += "largest stretch " + to_fixed(100 * r.embedding.max_stretch, 2) + " %, angular defects " +
            to_fixed(degrees(r.defects.min), 1) + " to " + to_fixed(degrees(r.defects.max), 1) + " degrees, " +
            std::to_string(r.hard_nodes) + " nodes hard to hook\n";
    for (const std::string& warning : r.warnings) {
        text += "warning: " + warning + "\n";
    }
    if (const std::string problem = build_problem(r); !problem.empty()) {
        text += "problem: " + problem + "\n";
    }
    return text + "wrote " + design + " and the picture " + picture_path(design) + "\n";
}

nlohmann::ordered_json as_json(const Deviation& deviation, double la)
{
    return {{"rms_mm", deviation.rms},
            {"max_mm", deviation.max},
            {"rms_la", deviation.rms / la},
            {"max_la", deviation.max / la}};
}

std::string as_json(const ImportedMesh& made)
{
    const ImportReport& r = made.report;
    const nlohmann::ordered_json root = {{"elements", r.elements},
                                         {"elements_asked", r.elements_asked},
                                         {"la_mm", r.la},
                                         {"to_target", as_json(r.distance.to_target, r.la)},
                                         {"from_target", as_json(r.distance.from_target, r.la)},
                                         {"max_stretch", r.embedding.max_stretch},
                                         {"converged", r.embedding.converged},
                                         {"min_defect_deg", degrees(r.defects.min)},
                                         {"max_defect_deg", degrees(r.defects.max)},
                                         {"hard_nodes", r.hard_nodes},
                                         {"crosses", r.crosses},
                                         {"scale", r.scale},
                                         {"shift_mm", {r.shift.x(), r.shift.y(), r.shift.z()}},
                                         {"repairs", r.repairs},
                                         {"warnings", r.warnings},
                                         {"problem", build_problem(r)}};
    return root.dump(1) + "\n";
}

Expected<ImportedMesh> make(const ImportArguments& arguments, Progress& progress)
{
    constexpr std::size_t max_bytes = 2'000'000'000;
    ImportOptions options;
    const auto usable = element(arguments);
    if (!usable) {
        return tl::make_unexpected(usable.error());
    }
    options.element = *usable;
    options.size = arguments.size;
    options.progress = [&](const std::string& what) {
        progress.show(what);
        return true;
    };
    progress.show("reading " + arguments.mesh);
    auto bytes = load_file(arguments.mesh, max_bytes);
    if (!bytes) {
        return tl::make_unexpected(bytes.error());
    }
    const auto file = read_mesh(arguments.mesh, *bytes);
    bytes->clear();
    bytes->shrink_to_fit();
    return file
        .and_then([&](const MeshFile& read) {
            options.mm_per_unit = read.metres ? 1000 : 1;
            return import_mesh(read.mesh, options);
        })
        .map_error([&](const Error& error) {
            return Error{arguments.mesh + ": " + error.message, error.kind};
        });
}

//! Told before the long work: a missing folder, and what would replace the mesh or, as the picture would, the design.
Expected<void> check_output(const ImportArguments& arguments)
{
    const std::string picture = picture_path(arguments.output);
    const std::filesystem::path folder = std::filesystem::path(arguments.output).parent_path();
    std::error_code ignored;
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
        return machine_failure("cannot write " + arguments.output + ": there is no folder " + folder.string());
    }
    if (picture == arguments.output) {
        return refuse("the picture goes to " + picture + ": give the design another ending, .json is usual");
    }
    auto ok = spare_input(arguments.mesh, arguments.output);
    return ok ? spare_input(arguments.mesh, picture) : ok;
}

//! The target and the elements side by side.
Expected<std::string> comparison(const ImportedMesh& made)
{
    PictureOptions options;
    options.width = options.height = 480;
    const auto surface = network(made.operation);
    return surface ? comparison_png(*surface, made.element, made.target, options)
                   : Expected<std::string>(tl::make_unexpected(surface.error()));
}

//! The target is stored beside the design, under its content's hash, and a picture of both under the design's name.
Expected<void> store(ImportedMesh& made, const std::string& output, const std::string& title)
{
    const TargetFile target = target_file(made.target);
    made.operation.target = target.name;
    made.operation.target_sha256 = target.sha256;
    Design design;
    design.title = title;
    design.element = made.element;
    design.operations = {made.operation};
    const auto picture = comparison(made);
    if (!picture) {
        return tl::make_unexpected(picture.error());
    }
    const std::filesystem::path path(output);
    const std::vector<std::pair<std::filesystem::path, const std::string*>> beside = {
        {path.parent_path() / target.name, &target.bytes}, {picture_path(output), &*picture}};
    for (const auto& [name, bytes] : beside) {
        if (auto ok = save_file(name.string(), *bytes); !ok) {
            return ok;
        }
    }
    return save_file(output, write_design(design));
}

Expected<int> run_import(const ImportArguments& arguments)
{
    if (auto ok = check_output(arguments); !ok) {
        return tl::make_unexpected(ok.error());
    }
    Progress progress;
    auto made = make(arguments, progress);
    if (!made) {
        return tl::make_unexpected(made.error());
    }
    if (auto ok = store(*made, arguments.output, title_of(std::filesystem::path(arguments.mesh).stem().string())); !ok) {
        return tl::make_unexpected(ok.error());
    }
    const bool good = build_problem(made->report).empty();
    return print(arguments.json ? as_json(*made) : as_text(*made, arguments.output)).map([good] {
        return good ? 0 : 1;
    });
}

} // namespace

void add_import(CLI::App& app, Run& run)
{
    auto* command = app.add_subcommand("import", "Make a design from a mesh: OBJ, PLY, STL, OFF or GLB.");
    command->footer(
        "Example: rhombloom import vase.obj -o vase.json --elements 600 --height 400\n"
        "Give at most two of --elements, --la and --height; the third follows. The repaired target is stored "
        "beside the design, and a picture of both (vase.png).");
    auto arguments = std::make_shared<ImportArguments>();
    command->add_option("MESH", arguments->mesh, "file with the target")->required();
    command->add_option("-o,--output", arguments->output, "design file to write")->required();
    command->add_option("--elements", arguments->size.elements, "how many elements (600)");
    command->add_option("--la", arguments->size.la, "short side of the element, mm (80)");
    command->add_option("--height", arguments->size.height, "of the target, along z, mm (1 to 100000)")
        ->check(in_range(1, 1e5));
    command->add_option("--lb", arguments->lb, "long side, mm (1.1 la)");
    command->add_option("--alpha", arguments->alpha_deg, "acute angle, degrees (63.435)");
    command->add_option("--thickness", arguments->thickness, "of the sheet, mm (0.5)");
    command->add_flag("--json", arguments->json, "machine-readable report");
    command->callback([&run, arguments] { run = [arguments] { return run_import(*arguments); }; });
}

} // namespace rhombloom::cli
