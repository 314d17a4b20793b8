#pragma once

#include "core/design/design.h"

namespace rhombloom {

//! \brief The surface that an import describes, not embedded.
//! \details Refuses, with the numbers, what make_surface refuses and sides that do not alternate.
Expected<Surface> network(const Import& import);

//! \brief The import that describes \p surface, embedded. Positions are rounded to 0.001 mm.
Import import_of(const Surface& surface, const std::string& id);

} // namespace rhombloom
