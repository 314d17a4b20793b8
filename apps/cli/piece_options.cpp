#include "apps/cli/piece_options.h"

#include "apps/cli/usage.h"
#include "core/text.h"

namespace rhombloom::cli {

namespace {

//! The element comes from the design file.
bool is_option(const Parameter& parameter)
{
    return parameter.section != "Element";
}

} // namespace

std::shared_ptr<PieceOptions> add_piece_options(CLI::App& command)
{
    auto options = std::make_shared<PieceOptions>();
    const auto& table = parameter_table();
    options->values.resize(table.size());
    options->set.resize(table.size(), nullptr);
    options->material_set = command.add_option(
        "--material", options->material,
        "what is cut: pp-0.5, card-300, ... (an unknown name lists them; default: by the thickness)");
    command
        .add_option("--max-stretch", options->max_stretch,
                    "of an element, for a sheet that gives more than the usual 1 % (percent, 0.1 to 5)")
        ->check(in_range(0.1, 5))
        ->option_text("FLOAT");
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (is_option(table[i])) {
            options->set[i] =
                command
                    .add_option(option_name(table[i]), options->values[i],
                                table[i].help + " (" + to_text(table[i].min) + " to " + to_text(table[i].max) + " " +
                                    table[i].unit + ", default: " + to_text(table[i].rule) + ")")
                    ->group(table[i].section);
        }
    }
    return options;
}

std::vector<ParameterSetting> PieceOptions::settings() const
{
    std::vector<ParameterSetting> result;
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (set[i] != nullptr && set[i]->count() > 0) {
            result.emplace_back(parameter_table()[i].name, values[i]);
        }
    }
    return result;
}

Expected<Piece> PieceOptions::piece(const Element& element) const
{
    auto piece = make_piece(element, material_set->count() > 0 ? std::optional(material) : std::nullopt, settings());
    if (piece) {
        piece->stretch_limit = max_stretch / 100;
    }
    return piece;
}

} // namespace rhombloom::cli
