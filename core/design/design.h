#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/model/surface.h"

namespace rhombloom {

//! \brief Put a base shape into the scene, as a new part named \p id.
struct Place
{
    std::string id;
    std::string shape;
    Vec3 position = Vec3::Zero();     //!< mm
    Vec3 rotation_deg = Vec3::Zero(); //!< about x, then y, then z
};

using Operation = std::variant<Place>;

//! \brief The document: an element and a history of operations (DESIGN.md section 4). The surface is its replay.
struct Design
{
    static constexpr int version = 1;

    std::string title;
    Element element;
    std::vector<Operation> operations;
};

} // namespace rhombloom
