#include <map>

#include "apps/cli/commands.h"
#include "apps/cli/console.h"
#include "apps/cli/usage.h"
#include "core/building/bulb_hatch.h"
#include "core/text.h"
#include "exporters/plan_file.h"

namespace rhombloom::cli {

namespace {

std::string as_text(const Scorecard& score)
{
    return "steps                          " + std::to_string(score.steps) + "\ninserts                        " +
           std::to_string(score.inserts) + "\nreopened elements              " + std::to_string(score.removals) +
           "\nparts needed                   " + std::to_string(score.parts_needed) +
           "\nexposure (sides waiting)       " + std::to_string(score.exposure) + "\none-neighbour inserts          " +
           std::to_string(score.one_neighbour_inserts) + "\nfour-at-once inserts           " +
           std::to_string(score.four_at_once_inserts) + "\ninserts at negative defects    " +
           std::to_string(score.negative_defect_inserts) + "\nview turns                     " +
           std::to_string(score.view_turns) + "\nestimated minutes              " + to_fixed(score.minutes, 0) + "\n";
}

Expected<int> run_plan(const std::string& path, Order order, bool json)
{
    const auto design = load_design(path);
    if (!design) {
        return tl::make_unexpected(design.error());
    }
    Progress progress;
    const auto replayed = replay_design(path, *design, progress);
    if (!replayed) {
        return tl::make_unexpected(replayed.error());
    }
    progress.show("ordering the elements");
    const AssemblyPlan plan = design_plan(*design, *replayed, design->element, order);
    return print(json ? plan_json(*replayed, design->element, plan, booklet_layout(*replayed, plan, {}))
                      : as_text(plan.scorecard))
        .map([] { return 0; });
}

} // namespace

void add_plan(CLI::App& app, Run& run)
{
    auto* command = app.add_subcommand("plan", "In what order the elements are put together, and how good that is.");
    command->footer("Example: rhombloom plan examples/ball-30.json --order paper");
    auto design = std::make_shared<std::string>();
    auto order = std::make_shared<Order>(Order::Best);
    auto json = std::make_shared<bool>(false);
    command->add_option("DESIGN", *design, "design file")->required();
    command->add_option("--order", *order, "best (default) or paper")
        ->transform(one_of<Order>({{"best", Order::Best}, {"paper", Order::Paper}}))
        ->option_text("NAME");
    command->add_flag("--json", *json, "the whole plan, machine-readable");
    command->callback(
        [&run, design, order, json] { run = [design, order, json] { return run_plan(*design, *order, *json); }; });
}

} // namespace rhombloom::cli
