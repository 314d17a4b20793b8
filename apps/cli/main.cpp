#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/usage.h"

namespace {

using namespace rhombloom;

enum ExitCode
{
    success = 0,
    input_at_fault = 1,
    wrong_usage = 2,
    our_fault = 3
};

//! One line, whatever a file name or a key in a file may contain.
std::string one_line(std::string text)
{
    for (char& c : text) {
        const auto code = static_cast<unsigned char>(c);
        c = code < 0x20 || code == 0x7f ? '?' : c;
    }
    return text;
}

int complain(const std::string& message, int exit_code)
{
    std::fprintf(stderr, "rhombloom: %s\n", one_line(message).c_str());
    return exit_code;
}

//! Every command knows --version, as the program itself does.
void add_version(CLI::App& app)
{
    const std::string version = "rhombloom " RHOMBLOOM_VERSION;
    app.set_version_flag("--version", version);
    for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
        command->set_version_flag("--version", version);
    }
}

//! Is it a number, though perhaps not a whole one or one of usual size?
bool is_number(const std::string& text)
{
    double value = 0;
    return std::from_chars(text.data(), text.data() + text.size(), value).ptr == text.data() + text.size();
}

//! CLI11's sentence; it says "Could not convert: --count = 1.5" of what is no number, or no whole one.
std::string sentence_of(const CLI::ParseError& error)
{
    const std::string text = error.what(), start = "Could not convert: ";
    if (!text.starts_with(start)) {
        return text;
    }
    const std::string value = text.substr(text.rfind(' ') + 1);
    return text.substr(start.size()) + ": expected a " + (is_number(value) ? "whole number of usual size" : "number");
}

int run_program(int argc, char** argv)
{
    CLI::App app("Designs surfaces from copies of one interlocking element and makes everything needed to build them.",
                 "rhombloom");
    app.require_subcommand(1);
    app.footer("Example: rhombloom fabricate examples/ball-30.json -o kit\n"
               "`rhombloom COMMAND --help` tells more about each command.");
    cli::Run run;
    for (const auto add : {cli::add_fabricate, cli::add_check, cli::add_embed, cli::add_shapes, cli::add_plan,
                           cli::add_nest, cli::add_import, cli::add_studio}) {
        add(app, run);
    }
    add_version(app);
    cli::refuse_empty_values(app);
    const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    if (const std::string sentence = cli::unknown_name(app, arguments); !sentence.empty()) {
        return complain(sentence, wrong_usage);
    }
    try {
        std::vector<std::string> apart = cli::with_values_apart(app, arguments);
        std::reverse(apart.begin(), apart.end()); // as CLI11 expects them
        app.parse(std::move(apart));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
            return app.exit(error); // --help and --version
        }
        return complain(sentence_of(error) + " (see " + cli::called(app, arguments) + " --help)", wrong_usage);
    }
    const auto result = run();
    if (result) {
        return *result;
    }
    return complain(result.error().message, result.error().kind == Error::Kind::Input ? input_at_fault : our_fault);
}

} // namespace

int main(int argc, char** argv)
{
    std::signal(SIGXFSZ, SIG_IGN); // a file size limit is a write that fails, not a crash
    try {
        return run_program(argc, argv);
    } catch (const std::bad_alloc&) {
        return complain("out of memory: try a smaller design", our_fault);
    } catch (const std::exception& error) {
        return complain(std::string("a bug stopped the program (") + error.what() +
                            "); please report it with the design file",
                        our_fault);
    }
}
