#include "apps/cli/console.h"

#include <cstdio>
#include <filesystem>

#include <unistd.h>

#include "core/design/design_file.h"
#include "exporters/save.h"

namespace rhombloom::cli {

namespace {

bool line_shown = false; // there is one terminal

//! Takes the line of progress off the terminal: results may follow there.
void wipe()
{
    if (line_shown) {
        std::fputs("\r\x1b[K", stderr);
        std::fflush(stderr);
        line_shown = false;
    }
}

} // namespace

Progress::Progress(std::chrono::milliseconds patience)
    : terminal_(::isatty(STDERR_FILENO) == 1), patience_(patience), start_(std::chrono::steady_clock::now())
{
}

Progress::~Progress()
{
    wipe();
}

void Progress::show(const std::string& what)
{
    if (terminal_ && std::chrono::steady_clock::now() - start_ >= patience_) {
        std::fprintf(stderr, "\r\x1b[K%s ...", what.c_str());
        std::fflush(stderr);
        line_shown = true;
    }
}

Expected<Design> load_design(const std::string& path)
{
    constexpr std::size_t max_bytes = 64'000'000;
    const auto bytes = load_file(path, max_bytes);
    if (!bytes) {
        return tl::make_unexpected(bytes.error());
    }
    auto design = parse_design(*bytes);
    if (!design) {
        return refuse(path + ": " + design.error().message);
    }
    return design;
}

Expected<Replay> replay_design(const std::string& path, const Design& design, Progress& progress)
{
    ReplayOptions options;
    options.progress = [&](int number, int count, const std::string& what) {
        progress.show("operation " + std::to_string(number + 1) + " of " + std::to_string(count) + ": " + what);
        return true;
    };
    auto result = replay(design, options);
    if (!result) {
        return tl::make_unexpected(Error{path + ": " + result.error().message, result.error().kind});
    }
    return result;
}

Expected<void> spare_input(const std::string& input, const std::string& output)
{
    std::error_code ignored;
    if (std::filesystem::equivalent(input, output, ignored)) {
        return refuse(output + " would replace what was read from " + input + ": give another name");
    }
    return {};
}

Expected<void> spare_input(const std::string& input, const std::string& folder, const FileSet& files)
{
    for (const auto& [name, bytes] : files) {
        if (auto ok = spare_input(input, (std::filesystem::path(folder) / name).string()); !ok) {
            return ok;
        }
    }
    return {};
}

Expected<void> print(const std::string& text)
{
    wipe();
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        return machine_failure("cannot write to the standard output: is the disk full?");
    }
    return {};
}

} // namespace rhombloom::cli
