#pragma once

#include "exporters/outline.h"
#include "exporters/parameter_table.h"
#include "exporters/save.h"

namespace rhombloom {

//! \brief The OpenSCAD templates with the design's values in their parameter blocks, their presets, and a page that
//! explains them.
//! \details Every template of `templates/` is copied to `hooks/`; each parameter's literal is replaced, once, and a
//! hidden block is appended by which the file tells a maker whether it still is the project's part and proves that
//! OpenSCAD and this toolkit draw the same outline. Nothing but literals and the cleaned title goes in, so a name
//! pasted from a design cannot become code. A value outside its slider's range widens the range.
//! \return `hooks/NAME.scad` and `hooks/NAME.json` for every name of scad_templates(), and `hooks/README.txt`. Refused
//! when the parameters give no outline; a machine failure when a template cannot be read or does not have each
//! parameter exactly once.
Expected<FileSet> hook_files(const HookParameters& parameters, const std::string& title);

//! \brief The same with the kerf of the machine, for the templates that draw the cut sheet. A kerf that closes the slit
//! is left out: the template draws the finished edge then.
Expected<FileSet> hook_files(const PieceParameters& parameters, const std::string& title);

//! What a template draws.
enum class ScadPart
{
    Sheet,    //!< the element's own outline: has kerf and fingerprint of the outline
    Connector //!< a part that holds the element's edge
};

struct ScadTemplate
{
    std::string name; //!< "element" for templates/element.scad
    ScadPart part = ScadPart::Sheet;
};

const std::vector<ScadTemplate>& scad_templates();

//! \brief The rows of the parameter table that a template's parameter block has.
std::vector<Parameter> scad_parameters(ScadPart part);

//! \brief The literal of a row: twelve decimals at most.
std::string scad_literal(const Parameter& row, const PieceParameters& parameters);

//! \brief "automatic" when all hook sizes follow from la, thickness and slit clearance by the table's rules, else
//! "given": the value of the templates' parameter hook_sizes.
std::string hook_sizes(const PieceParameters& parameters);

//! \brief \p title reduced to letters, digits, space, dot, underscore and minus, at most 60 of them.
std::string clean_title(const std::string& title);

//! \brief \p scad with `name = literal;` at the start of a line replaced by `name = value;`, the rest of the line kept.
//! \return a machine failure unless there is exactly one such line.
Expected<std::string> with_literal(const std::string& scad, const std::string& name, const std::string& value);

} // namespace rhombloom
