#pragma once

#include "core/design/design.h"

namespace rhombloom::studio {

//! \brief Refuse an operation that would keep the studio busy for minutes: a shape or brush of more than 3000 elements,
//! a pull of more than 100 sides. The command line takes them.
Expected<void> check_size(const Operation& operation, const Element& element);

} // namespace rhombloom::studio
