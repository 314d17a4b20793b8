#pragma once

#include "exporters/outline.h"
#include "exporters/save.h"

namespace rhombloom {

//! \brief The OpenSCAD templates with the design's values in their parameter blocks, and a page that explains them.
//! \details Every template of `templates/` is copied to `hooks/`; each parameter's literal is replaced, once, and a
//! hidden block is appended by which the file tells a maker whether it still is the project's part and proves that
//! OpenSCAD and this toolkit draw the same outline. Nothing but literals and the cleaned title goes in, so a name
//! pasted from a design cannot become code.
//! \return `hooks/element.scad` and the other templates, `hooks/README.txt`. Refused when the parameters give no
//! outline; a machine failure when a template is missing or does not have each parameter exactly once.
Expected<FileSet> hook_files(const HookParameters& parameters, const std::string& title);

//! \brief \p title reduced to letters, digits, space, dot, underscore and minus, at most 60 of them.
std::string clean_title(const std::string& title);

//! \brief \p scad with `name = literal;` at the start of a line replaced by `name = value;`, the rest of the line kept.
//! \return a machine failure unless there is exactly one such line.
Expected<std::string> with_literal(const std::string& scad, const std::string& name, const std::string& value);

} // namespace rhombloom
