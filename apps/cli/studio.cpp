#include <cstdlib>
#include <filesystem>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/cli/commands.h"
#include "apps/cli/console.h"
#include "apps/cli/usage.h"
#include "apps/studio/server/guard.h"
#include "apps/studio/server/server.h"

extern char** environ; // NOLINT: POSIX wants it declared by the program

namespace rhombloom::cli {

namespace {

struct StudioOptions
{
    std::string design;
    int port = 0;
    bool no_browser = false;
    std::string pages = RHOMBLOOM_STUDIO_PAGES;
};

//! "untitled.json", or the next number that is free.
std::string fresh_name()
{
    std::string name = "untitled.json";
    for (int k = 2; std::filesystem::exists(name); ++k) {
        name = "untitled-" + std::to_string(k) + ".json";
    }
    return name;
}

//! Hand the address to the desktop's own opener; without one, or without a desktop, the user opens it.
void open_browser(const std::string& address)
{
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) {
        return;
    }
    std::string program = "xdg-open";
    std::string argument = address;
    char* arguments[] = {program.data(), argument.data(), nullptr};
    pid_t child = 0;
    posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ);
}

Expected<int> run_studio(const StudioOptions& options)
{
    const auto pages = studio::load_pages(options.pages);
    if (!pages) {
        return tl::make_unexpected(pages.error());
    }
    const std::string file = options.design.empty() ? fresh_name() : options.design;
    auto session = studio::Session::open(file);
    if (!session) {
        return tl::make_unexpected(session.error());
    }
    studio::Studio studio(std::move(*session), studio::Shelf(studio::default_shelf_path()), RHOMBLOOM_VERSION);
    studio::ServerOptions server;
    server.port = options.port;
    server.pages = *pages;
    server.token = studio::random_token();
    server.listening = [&](const std::string& address) {
        (void)print("the studio is open at " + address + "\nevery change is saved to " + file +
                    "; stop it with Ctrl+C\n");
        if (!options.no_browser) {
            open_browser(address);
        }
    };
    return studio::serve(studio, server).map([] { return 0; });
}

} // namespace

void add_studio(CLI::App& app, Run& run)
{
    auto options = std::make_shared<StudioOptions>();
    auto* command = app.add_subcommand("studio", "Design by clicking and dragging, in the browser.");
    command->footer(
        "Example: rhombloom studio bunny.json\nThe page is served to this machine only. Changes are saved to "
        "the design file as you make them.");
    command->add_option("DESIGN", options->design, "design file; a new one when it is missing");
    command->add_option("--port", options->port, "default: any free one")
        ->check(in_range(0, 65535))
        ->option_text("INT");
    command->add_flag("--no-browser", options->no_browser, "only print the address");
    command->add_option("--pages", options->pages, "folder of the built page")->group("");
    command->callback([&run, options] { run = [options] { return run_studio(*options); }; });
}

} // namespace rhombloom::cli
