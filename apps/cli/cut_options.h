#pragma once

#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "exporters/cut_sheet.h"

namespace rhombloom::cli {

//! \brief The options about sheets and machines, as typed.
struct CutArguments
{
    std::string machine;
    std::string sheet;
    std::string colours;
    std::string remnant;
    std::string spares;
    std::optional<double> spacing;
    std::optional<double> margin;
    std::optional<double> stroke;
    double price_per_sheet = 0;
    double price_per_minute = 0;
    bool plain = false; //!< no numbers and arrows
    std::string dxf;
    Grain grain = Grain::Any;
};

std::shared_ptr<CutArguments> add_cut_options(CLI::App& command);

//! \brief Put them into \p options; refuses what is no size, machine, share,
//! ...
Expected<void> apply(const CutArguments& arguments, CutOptions& options);

} // namespace rhombloom::cli
