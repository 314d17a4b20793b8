#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace rhombloom::cli {

//! \brief The sentence about the first command or option among \p arguments (without the program's name) that \p app
//! does not know, with the nearest one that it does know; empty when all are known.
//! \details CLI11 itself would complain of something that is missing first, and suggests nothing.
std::string unknown_name(const CLI::App& app, std::span<const std::string> arguments);

//! \brief \p arguments with every option's name and value apart: "-o", "kit" of "-o=kit".
//! \details CLI11 itself would take "=kit" for the value, and of "--output=" the next argument.
std::vector<std::string> with_values_apart(const CLI::App& app, std::span<const std::string> arguments);

//! \brief The one of \p known that takes the fewest insertions, deletions, replacements and swaps to become \p name;
//! empty when none takes fewer than half of its letters.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

//! \brief Turns a name, in any case, into its value; refuses others with the names there are, in their order.
template <class T>
CLI::Validator one_of(std::vector<std::pair<std::string, T>> values)
{
    const auto convert = [values = std::move(values)](std::string& input) -> std::string {
        std::string known;
        for (const auto& [name, value] : values) {
            if (CLI::detail::to_lower(input) == name) {
                input = std::to_string(static_cast<int>(value));
                return "";
            }
            known += (known.empty() ? "" : ", ") + name;
        }
        return "\"" + input.substr(0, 40) + "\" is unknown; expected " + known;
    };
    return CLI::Validator(convert, "");
}

//! \brief Refuses what lies outside of \p min and \p max (both allowed), and what is no number at all (nan).
CLI::Validator in_range(double min, double max);

//! \brief Has the options of all commands refuse the empty value that an unset variable of the shell leaves; where a
//! number is expected CLI11 would take it for 0.
void refuse_empty_values(CLI::App& app);

//! \brief The command among \p arguments: "rhombloom nest", or "rhombloom" when there is none.
std::string called(const CLI::App& app, std::span<const std::string> arguments);

} // namespace rhombloom::cli
