#include "apps/cli/usage.h"

#include <algorithm>

#include "core/text.h"

namespace rhombloom::cli {

namespace {

std::size_t edits(const std::string& a, const std::string& b)
{
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d.back().back();
}

const CLI::App* command_of(const CLI::App& app, std::span<const std::string> arguments)
{
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (!arguments.empty() && command->get_name() == arguments.front()) {
            return command;
        }
    }
    return nullptr;
}

std::vector<std::string> command_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
    }
    return names;
}

std::vector<std::string> option_names(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
        for (const std::string& name : option->get_snames()) {
            names.push_back("-" + name);
        }
    }
    return names;
}

//! "--kerf" of "--kerf=0.2", "-o" of "-okit"; empty for what is no option: a value, a negative number, "-".
std::string option_name(const std::string& argument)
{
    if (argument.size() < 2 || argument[0] != '-' ||
        std::string("0123456789.").find(argument[1]) != std::string::npos) {
        return "";
    }
    return argument[1] == '-' ? argument.substr(0, argument.find('=')) : argument.substr(0, 2);
}

//! Does the argument name an option and, behind a '=', its value?
bool holds_value(const CLI::App& command, const std::string& argument)
{
    const std::size_t end = argument.find('=');
    if (end == std::string::npos || argument[0] != '-') {
        return false;
    }
    const CLI::Option* option = command.get_option_no_throw(argument.substr(0, end));
    return option != nullptr && option->get_items_expected_min() > 0;
}

std::string unknown_command(const CLI::App& app, const std::string& name)
{
    const std::vector<std::string> known = command_names(app);
    std::string list;
    for (const std::string& command : known) {
        list += (list.empty() ? "" : ", ") + command;
    }
    const std::string nearest = nearest_name(name, known);
    return "unknown command \"" + name + "\": " + (nearest.empty() ? "" : "did you mean " + nearest + "? ") +
           "Commands are " + list;
}

} // namespace

CLI::Validator in_range(double min, double max)
{
    const auto check = [min, max](std::string& input) -> std::string {
        double value = 0;
        const bool inside = CLI::detail::lexical_cast(input, value) && value >= min && value <= max;
        return inside ? "" : input.substr(0, 40) + " is not from " + to_text(min) + " to " + to_text(max);
    };
    return CLI::Validator(check, "");
}

void refuse_empty_values(CLI::App& app)
{
    const CLI::Validator given([](std::string& input) { return input.empty() ? "the value is empty" : std::string(); },
                               "");
    for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
        for (CLI::Option* option : command->get_options()) {
            if (!option->get_positional() && option->get_items_expected_min() > 0) {
                option->transform(given); // asked before the option's own
            }
        }
    }
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& known)
{
    std::string nearest;
    std::size_t least = name.size() / 2 + 1;
    for (const std::string& candidate : known) {
        // What begins the same is what was meant: --price for --price-per-sheet.
        const std::size_t distance = candidate.starts_with(name) && name.size() > 4 ? 1 : edits(name, candidate);
        if (distance < least) {
            least = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::vector<std::string> with_values_apart(const CLI::App& app, std::span<const std::string> arguments)
{
    const CLI::App* command = command_of(app, arguments);
    std::vector<std::string> apart;
    bool names_only = false; // what follows "--"
    for (const std::string& argument : arguments) {
        names_only = names_only || argument == "--";
        if (names_only || !holds_value(command == nullptr ? app : *command, argument)) {
            apart.push_back(argument);
            continue;
        }
        const std::size_t end = argument.find('=');
        apart.push_back(argument.substr(0, end));
        apart.push_back(argument.substr(end + 1));
    }
    return apart;
}

std::string called(const CLI::App& app, std::span<const std::string> arguments)
{
    const CLI::App* command = command_of(app, arguments);
    return app.get_name() + (command == nullptr ? "" : " " + command->get_name());
}

std::string unknown_name(const CLI::App& app, std::span<const std::string> arguments)
{
    if (arguments.empty()) {
        return "";
    }
    const CLI::App* command = command_of(app, arguments);
    if (command == nullptr && !arguments.front().starts_with('-')) {
        return unknown_command(app, arguments.front());
    }
    const std::vector<std::string> known = option_names(command == nullptr ? app : *command);
    for (const std::string& argument : arguments) {
        if (argument == "--") {
            break; // the rest are file names
        }
        const std::string name = option_name(argument);
        if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) {
            continue;
        }
        const std::string nearest = nearest_name(name, known);
        return "unknown option " + name + ": " + (nearest.empty() ? "" : "did you mean " + nearest + "? ") + "See " +
               called(app, arguments) + " --help";
    }
    return "";
}

} // namespace rhombloom::cli
