#include <algorithm>
#include <filesystem>

#include "apps/cli/commands.h"
#include "apps/cli/console.h"
#include "apps/cli/cut_options.h"
#include "apps/cli/piece_options.h"
#include "apps/cli/usage.h"
#include "core/text.h"
#include "exporters/manifest.h"
#include "exporters/target_file.h"
#include "exporters/words.h"

namespace rhombloom::cli {

namespace {

struct FabricateOptions
{
    std::string design;
    std::string output;
    std::vector<KitPart> only;
    KitOptions kit;
    std::shared_ptr<PieceOptions> piece;
    std::shared_ptr<CutArguments> cut;
};

std::string summary(const Kit& kit, const std::string& folder)
{
    std::string text = "wrote " + std::to_string(kit.files.size()) + " files to " + folder;
    if (kit.cut.sheets > 0) {
        text += ": " + std::to_string(kit.cut.elements + kit.cut.spares) + " elements on " +
                plural(kit.cut.sheets, "sheet") + ", " + to_fixed(kit.cut.cut_length_m, 1) + " m to cut, " +
                duration(kit.cut.minutes, 1);
    }
    text += ". Start with README.txt.\n";
    for (const std::string& warning : kit.warnings) {
        text += "note: " + warning + "\n";
    }
    return text;
}

//! Files of an older kit in the same folder that the new one does not have: a
//! seventh sheet, say.
void remove_stale(const std::string& folder, const std::vector<std::string>& old, const FileSet& files)
{
    for (const std::string& name : old) {
        const bool inside = name.find("..") == std::string::npos && !name.starts_with("/");
        if (inside && !files.contains(name)) {
            std::error_code ignored;
            std::filesystem::remove(std::filesystem::path(folder) / name, ignored);
        }
    }
}

//! A folder that never held a kit keeps its files.
Expected<void> spare_foreign(const std::string& folder, const FileSet& files)
{
    for (const auto& [name, bytes] : files) {
        const std::string path = (std::filesystem::path(folder) / name).string();
        std::error_code ignored;
        if (std::filesystem::is_regular_file(path, ignored)) {
            return machine_failure(path + " is not of a kit (there is no kit.json beside it) and would be replaced: " +
                                   "give another folder");
        }
    }
    return {};
}

Expected<Kit> make(FabricateOptions& options, Progress& progress)
{
    if (!options.only.empty()) {
        options.kit.parts = {options.only.begin(), options.only.end()};
    }
    const auto design = load_design(options.design);
    if (!design) {
        return tl::make_unexpected(design.error());
    }
    const auto piece = options.piece->piece(design->element);
    if (!piece) {
        return tl::make_unexpected(piece.error());
    }
    if (auto ok = apply(*options.cut, options.kit.cut); !ok) {
        return tl::make_unexpected(ok.error());
    }
    if (const auto ok = check_names(*design, options.kit); !ok) {
        return tl::make_unexpected(
            Error{options.design + ": " + ok.error().message + ", or leave the booklet out (--only cut,preview,hooks)",
                  ok.error().kind});
    }
    const auto replayed = replay_design(options.design, *design, progress);
    if (!replayed) {
        return tl::make_unexpected(replayed.error());
    }
    if (options.kit.parts.contains(KitPart::Preview)) {
        auto target = load_targets(*design, std::filesystem::path(options.design).parent_path().string());
        if (!target) {
            return tl::make_unexpected(Error{options.design + ": " + target.error().message, target.error().kind});
        }
        options.kit.target = std::move(*target);
    }
    options.kit.progress = [&](const std::string& what) { progress.show(what); };
    options.kit.program_version = RHOMBLOOM_VERSION;
    return make_kit(*design, *replayed, *piece, options.kit);
}

Expected<int> run_fabricate(FabricateOptions& options)
{
    Progress progress;
    const auto kit = make(options, progress);
    if (!kit) {
        return tl::make_unexpected(kit.error());
    }
    constexpr std::size_t max_manifest = 10'000'000;
    const auto old = load_file((std::filesystem::path(options.output) / "kit.json").string(), max_manifest);
    auto spared = spare_input(options.design, options.output, kit->files);
    if (spared && !old) {
        spared = spare_foreign(options.output, kit->files);
    }
    if (!spared) {
        return tl::make_unexpected(spared.error());
    }
    if (auto ok = save_folder(options.output, kit->files); !ok) {
        return tl::make_unexpected(ok.error());
    }
    if (old && options.only.empty()) {
        remove_stale(options.output, listed_files(*old), kit->files);
    }
    return print(summary(*kit, options.output)).map([] { return 0; });
}

} // namespace

void add_fabricate(CLI::App& app, Run& run)
{
    auto options = std::make_shared<FabricateOptions>();
    auto* command = app.add_subcommand("fabricate", "The main job: make the whole kit from a design.");
    command->footer("Example: rhombloom fabricate examples/ball-30.json -o kit "
                    "--machine glowforge --kerf 0.2");
    command->add_option("DESIGN", options->design, "design file")->required();
    command->add_option("-o,--output", options->output, "folder of the kit; made when it is missing")->required();
    command->add_option("--only", options->only, "only these parts: cut,booklet,preview,hooks")
        ->delimiter(',')
        ->transform(one_of<KitPart>({{"cut", KitPart::Cut},
                                     {"booklet", KitPart::Booklet},
                                     {"preview", KitPart::Preview},
                                     {"hooks", KitPart::Hooks}}))
        ->option_text("PART,...");
    command->add_option("--paper", options->kit.paper, "of booklet and template: a4 (default) or letter")
        ->transform(one_of<Paper>({{"a4", Paper::A4}, {"letter", Paper::Letter}}))
        ->option_text("NAME");
    command->add_option("--order", options->kit.order, "of assembly: best (default) or paper")
        ->transform(one_of<Order>({{"best", Order::Best}, {"paper", Order::Paper}}))
        ->option_text("NAME");
    command->add_flag_callback(
        "--lamp", [options] { options->kit.lamp = LampLook::On; }, "show it lit in the preview");
    options->piece = add_piece_options(*command);
    options->cut = add_cut_options(*command);
    command->callback([&run, options] { run = [options] { return run_fabricate(*options); }; });
}

} // namespace rhombloom::cli
