#include <memory>

#include "apps/cli/commands.h"
#include "apps/cli/console.h"
#include "apps/cli/usage.h"
#include "core/text.h"
#include "exporters/machines.h"
#include "exporters/nesting_files.h"
#include "exporters/save.h"

namespace rhombloom::cli {

namespace {

constexpr std::size_t most_bytes = 50'000'000;

struct NestCommand
{
    std::string outline, output, sheet = "600x400", remnant;
    bool mirror = false;
    NestOptions options;
};

Expected<NestOptions> options_of(const NestCommand& command)
{
    NestOptions options = command.options;
    const auto sheet = parse_sheet(command.sheet);
    if (!sheet) {
        return tl::make_unexpected(sheet.error());
    }
    options.sheet_width = sheet->width;
    options.sheet_height = sheet->height;
    options.mirror = command.mirror ? Mirror::Allowed : Mirror::Never;
    if (!command.remnant.empty()) {
        const auto remnant = parse_sheet(command.remnant);
        if (!remnant) {
            return tl::make_unexpected(remnant.error());
        }
        options.remnant = Vec2(remnant->width, remnant->height);
    }
    return options;
}

Expected<int> run_nest(const NestCommand& command)
{
    const auto options = options_of(command);
    if (!options) {
        return tl::make_unexpected(options.error());
    }
    const auto bytes = load_file(command.outline, most_bytes);
    if (!bytes) {
        return tl::make_unexpected(bytes.error());
    }
    const auto outline = read_outline(command.outline, *bytes);
    if (!outline) {
        return tl::make_unexpected(outline.error());
    }
    Progress progress(std::chrono::milliseconds(0));
    progress.show("nesting");
    const auto nesting = nest(*outline, *options).map_error([&](const Error& error) {
        return Error{command.outline + ": " + error.message, error.kind};
    });
    if (!nesting) {
        return tl::make_unexpected(nesting.error());
    }
    progress.show("writing " + std::to_string(nesting->sheets.size()) + " sheets");
    const FileSet files = nesting_files(*outline, *options, *nesting);
    if (auto ok = spare_input(command.outline, command.output, files); !ok) {
        return tl::make_unexpected(ok.error());
    }
    if (auto ok = save_folder(command.output, files); !ok) {
        return tl::make_unexpected(ok.error());
    }
    // Its size first: a wrong unit shows there.
    const Box box = bounds(outline->path);
    const std::string size = "outline of " + to_fixed(box.max.x() - box.min.x(), 2) + " x " +
                             to_fixed(box.max.y() - box.min.y(), 2) + " mm: ";
    return print(size + summary(*nesting, *options) + "; wrote " + command.output + "\n").map([] { return 0; });
}

} // namespace

void add_nest(CLI::App& app, Run& run)
{
    auto* command = app.add_subcommand("nest", "Lay many copies of one outline on as few sheets as possible.");
    command->footer("Writes sheet-01.svg and .dxf, ..., and nesting.json with every placement.\n"
                    "Example: rhombloom nest outline.dxf -o sheets --sheet 600x400 --count 188 --spacing 2");
    auto given = std::make_shared<NestCommand>();
    command->add_option("OUTLINE", given->outline, "one closed contour: .svg, .dxf or .json {\"outline\": [[x,y],...]}")
        ->required();
    command->add_option("-o,--output", given->output, "folder to write")->required();
    command->add_option("--sheet", given->sheet, "sheet size WxH in mm, or WxHin")->capture_default_str();
    command->add_option("--count", given->options.count, "number of copies")->required();
    command->add_option("--spacing", given->options.spacing, "mm between finished edges")->capture_default_str();
    command->add_option("--margin", given->options.margin, "mm between finished edges and the sheet's edge")
        ->capture_default_str();
    command->add_option("--grain", given->options.grain, "turns allowed on the sheet: any, half-turn or fixed")
        ->transform(one_of<Grain>({{"any", Grain::Any}, {"half-turn", Grain::HalfTurn}, {"fixed", Grain::Fixed}}))
        ->option_text("NAME=any");
    command->add_flag("--mirror", given->mirror, "copies may be cut as mirror images");
    command->add_option("--remnant", given->remnant, "size WxH of an offcut that is filled first");
    command->callback([&run, given] { run = [given] { return run_nest(*given); }; });
}

} // namespace rhombloom::cli
