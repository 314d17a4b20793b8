#pragma once

#include <memory>

#include <CLI/CLI.hpp>

#include "exporters/buildability.h"

namespace rhombloom::cli {

//! \brief The options that say which sheet and which hook: --material, --max-stretch
//! and one per row of the parameter table.
struct PieceOptions
{
    std::string material;
    std::vector<double> values;    //!< one per row of the table
    std::vector<CLI::Option*> set; //!< which of them the user gave
    CLI::Option* material_set = nullptr;
    double max_stretch = 100 * usual_stretch_limit; //!< per cent

    std::vector<ParameterSetting> settings() const;
    Expected<Piece> piece(const Element& element) const;
};

std::shared_ptr<PieceOptions> add_piece_options(CLI::App& command);

} // namespace rhombloom::cli
