#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "core/expected.h"

namespace rhombloom::cli {

//! What a chosen command does: its exit code, or the refusal that main() prints.
using Run = std::function<Expected<int>()>;

// One function per command: describes its options to CLI11 and, when the user chose it, fills in `run`.
void add_fabricate(CLI::App& app, Run& run);
void add_check(CLI::App& app, Run& run);
void add_embed(CLI::App& app, Run& run);
void add_shapes(CLI::App& app, Run& run);
void add_nest(CLI::App& app, Run& run);
void add_plan(CLI::App& app, Run& run);
void add_import(CLI::App& app, Run& run);
void add_studio(CLI::App& app, Run& run);

} // namespace rhombloom::cli
