#include "apps/cli/cut_options.h"

#include <charconv>

#include "apps/cli/usage.h"
#include "core/text.h"

namespace rhombloom::cli {

namespace {

//! "3%" or "0.03" or "5" pieces... only shares: a percentage or a number
//! below 1.
Expected<double> parse_share(const std::string& text)
{
    double value = 0;
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string rest(end.ptr, text.data() + text.size());
    const double share = rest == "%" ? value / 100 : value;
    if (end.ec != std::errc() || !(rest.empty() || rest == "%") || !(share >= 0 && share <= 1)) {
        return refuse("--spares is \"" + text.substr(0, 40) + "\": expected a share like 3% (0 to 100%)");
    }
    return share;
}

Expected<void> apply_length(const char* name, std::optional<double> value, double max, double& target)
{
    if (value && !(*value >= 0 && *value <= max)) {
        return refuse(std::string(name) + " is " + to_text(*value) + " mm: expected 0 to " + to_text(max) + " mm");
    }
    target = value.value_or(target);
    return {};
}

Expected<void> apply_sheet(const CutArguments& arguments, CutOptions& options)
{
    if (!arguments.machine.empty()) {
        const auto machine = find_machine(arguments.machine);
        if (!machine) {
            return tl::make_unexpected(machine.error());
        }
        use_machine(options, *machine);
    }
    if (!arguments.sheet.empty()) {
        const auto size = parse_sheet(arguments.sheet);
        if (!size) {
            return tl::make_unexpected(size.error());
        }
        options.sheet_width = size->width;
        options.sheet_height = size->height;
    }
    if (!arguments.remnant.empty()) {
        const auto size = parse_sheet(arguments.remnant);
        if (!size) {
            return tl::make_unexpected(size.error());
        }
        options.remnant = *size;
    }
    return {};
}

Expected<void> apply_style(const CutArguments& arguments, CutOptions& options)
{
    if (!arguments.colours.empty()) {
        const auto colours = parse_colours(arguments.colours);
        if (!colours) {
            return tl::make_unexpected(colours.error());
        }
        options.colours = *colours;
    }
    if (!arguments.spares.empty()) {
        const auto share = parse_share(arguments.spares);
        if (!share) {
            return tl::make_unexpected(share.error());
        }
        options.spares = *share;
    }
    if (!arguments.dxf.empty()) {
        options.dxf = arguments.dxf == "r12" ? DxfVersion::R12 : DxfVersion::R2000;
    }
    options.stroke_width = arguments.stroke;
    options.engraving = arguments.plain ? Engraving::Off : Engraving::On;
    options.grain = arguments.grain;
    options.price_per_sheet = arguments.price_per_sheet;
    options.price_per_minute = arguments.price_per_minute;
    return {};
}

} // namespace

std::shared_ptr<CutArguments> add_cut_options(CLI::App& command)
{
    auto a = std::make_shared<CutArguments>();
    const auto add = [&](const char* name, auto& target, const char* help) {
        return command.add_option(name, target, help)->group("Sheets");
    };
    add("--machine", a->machine, "a preset: k40, glowforge, cameo, a4, ... (an unknown name lists them)");
    add("--sheet", a->sheet, "size of the sheets, e.g. 600x400 (mm, the default) or 24x12in");
    add("--remnant", a->remnant, "an offcut that is filled first, e.g. 300x200");
    add("--spacing", a->spacing, "between finished edges, mm (default 2)");
    add("--margin", a->margin, "free along the sheet's edges, mm (default 3, or the machine's)");
    add("--spares", a->spares, "extra pieces, e.g. 3%");
    add("--colours", a->colours,
        "layer colours: lightburn, trotec, uls, epilog, k40, ponoko, glowforge, xtool, boxes (default: the machine's)");
    add("--stroke", a->stroke, "width of lines in SVG, mm (default 0.1; 0.01 with the colours of trotec and ponoko)")
        ->check(in_range(0.001, 2))
        ->option_text("MM");
    add("--dxf", a->dxf, "DXF version: r2000 (default) or r12")
        ->check(CLI::IsMember({"r2000", "r12"}))
        ->option_text("NAME");
    add("--grain", a->grain, "turns allowed on the sheet: any (default), half-turn or fixed")
        ->transform(one_of<Grain>({{"any", Grain::Any}, {"half-turn", Grain::HalfTurn}, {"fixed", Grain::Fixed}}))
        ->option_text("NAME");
    add("--price-per-sheet", a->price_per_sheet, "for the cost in kit.json")
        ->check(in_range(0, 1e6))
        ->option_text("NUMBER");
    add("--price-per-minute", a->price_per_minute, "of the machine")->check(in_range(0, 1e6))->option_text("NUMBER");
    command.add_flag("--no-engraving", a->plain, "no numbers and arrows on the pieces")->group("Sheets");
    return a;
}

Expected<void> apply(const CutArguments& arguments, CutOptions& options)
{
    if (auto ok = apply_sheet(arguments, options); !ok) {
        return ok;
    }
    if (auto ok = apply_length("--spacing", arguments.spacing, 50, options.spacing); !ok) {
        return ok;
    }
    if (auto ok = apply_length("--margin", arguments.margin, 200, options.margin); !ok) {
        return ok;
    }
    return apply_style(arguments, options);
}

} // namespace rhombloom::cli
