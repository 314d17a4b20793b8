#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/console.h"
#include "apps/cli/piece_options.h"
#include "core/text.h"
#include "exporters/words.h"

namespace rhombloom::cli {

namespace {

std::string angle(double value)
{
    return to_fixed(degrees(value), 1);
}

std::string as_text(const Buildability& report)
{
    std::string text = plural(report.elements, "element") + ", " + std::to_string(report.flipped) +
                       " of them flipped; " + plural(report.boundary_loops, "opening") + "\n";
    text += "angular defects " + angle(report.defects.min) + " to " + angle(report.defects.max) + " degrees\n";
    text += "largest stretch " + to_fixed(100 * report.embedding.max_stretch, 3) + " %, energy " +
            to_fixed(report.embedding.energy, 3) +
            (report.embedding.converged ? " mm, settled\n" : " mm, not settled\n");
    for (const HookCheck& check : report.hooks) {
        text += (check.ok ? "ok   " : "FAIL ") + check.id + (check.id.size() < 3 ? "  " : " ") + check.sentence + "\n";
    }
    for (const std::string& warning : report.warnings) {
        text += "note: " + warning + "\n";
    }
    for (const std::string& problem : report.problems) {
        text += "problem: " + problem + "\n";
    }
    return text + (report.ok() ? "It can be built.\n" : "It cannot be built like this.\n");
}

std::string as_json(const Buildability& report)
{
    auto hooks = nlohmann::ordered_json::array();
    for (const HookCheck& check : report.hooks) {
        hooks.push_back({{"id", check.id},
                         {"name", check.name},
                         {"ok", check.ok},
                         {"value", check.value},
                         {"limit", check.limit},
                         {"unit", check.unit},
                         {"sentence", check.sentence}});
    }
    const nlohmann::ordered_json root = {{"buildable", report.ok()},
                                         {"elements", report.elements},
                                         {"flipped", report.flipped},
                                         {"boundary_loops", report.boundary_loops},
                                         {"euler_characteristic", report.euler_characteristic},
                                         {"min_defect_deg", degrees(report.defects.min)},
                                         {"max_defect_deg", degrees(report.defects.max)},
                                         {"converged", report.embedding.converged},
                                         {"gradient_norm", report.embedding.gradient_norm},
                                         {"max_stretch", report.embedding.max_stretch},
                                         {"energy_mm", report.embedding.energy},
                                         {"hook_checks", hooks},
                                         {"warnings", report.warnings},
                                         {"problems", report.problems}};
    return root.dump(1) + "\n";
}

Expected<int> run_check(const std::string& path, const PieceOptions& options, bool json)
{
    const auto design = load_design(path);
    if (!design) {
        return tl::make_unexpected(design.error());
    }
    const auto piece = options.piece(design->element);
    if (!piece) {
        return tl::make_unexpected(piece.error());
    }
    Progress progress;
    const auto replayed = replay_design(path, *design, progress);
    if (!replayed) {
        return tl::make_unexpected(replayed.error());
    }
    const Buildability report = buildability(*replayed, *piece);
    return print(json ? as_json(report) : as_text(report)).map([&] { return report.ok() ? 0 : 1; });
}

} // namespace

void add_check(CLI::App& app, Run& run)
{
    auto* command = app.add_subcommand("check", "Can the design be built? Tags, defects, strains, hook checks.");
    command->footer("Example: rhombloom check examples/ball-30.json "
                    "--json\nExits with 1 when it cannot be built.");
    auto design = std::make_shared<std::string>();
    auto json = std::make_shared<bool>(false);
    command->add_option("DESIGN", *design, "design file")->required();
    command->add_flag("--json", *json, "machine-readable");
    const auto options = add_piece_options(*command);
    command->callback([&run, design, json, options] {
        run = [design, json, options] { return run_check(*design, *options, *json); };
    });
}

} // namespace rhombloom::cli
