#pragma once

#include <nlohmann/json.hpp>

#include "core/expected.h"

namespace rhombloom::studio {

//! \brief The user's own layouts, kept from design to design in one file.
//! \details {"layouts": [{"name", "elements", "joins"}]}, elements and joins as in a design's layout operation.
class Shelf
{
public:
    explicit Shelf(std::string path) : path_(std::move(path)) {}

    //! The list; empty when there is no file yet or it cannot be read.
    nlohmann::ordered_json layouts() const;

    //! Replace the list. Refuses what is no layout, more than 200 of them, and what cannot be written.
    Expected<void> keep(const nlohmann::json& layouts);

private:
    std::string path_;
};

//! \brief $XDG_DATA_HOME/rhombloom/layouts.json, or under ~/.local/share.
std::string default_shelf_path();

} // namespace rhombloom::studio
