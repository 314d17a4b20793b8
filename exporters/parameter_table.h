#pragma once

#include <string>
#include <utility>
#include <vector>

#include "exporters/kerf.h"
#include "exporters/outline.h"

namespace rhombloom {

//! \brief Everything that can be set about one piece: its outline and how it is cut.
struct PieceParameters
{
    HookParameters hook;
    Kerf kerf;
};

//! How a term of a rule depends on the acute angle.
enum class AngleFactor
{
    None,
    SineOfAlpha,
    CosineOfAlpha
};

//! \brief `factor * name`, times a function of alpha.
struct ParameterTerm
{
    std::string name; //!< of an earlier row
    double factor = 1;
    AngleFactor angle = AngleFactor::None;
};

//! \brief A default: the sum of the terms plus a constant, at least \p floor, at most \p cap plus \p cap_constant.
struct ParameterRule
{
    std::vector<ParameterTerm> terms = {};
    double constant = 0;
    double floor = -1e300;
    std::vector<ParameterTerm> cap = {}; //!< none: no upper bound
    double cap_constant = 0;
};

//! \brief One row of the table of parameters. Values in the row's own unit (mm or degrees).
struct Parameter
{
    std::string name;        //!< as in OpenSCAD and in files, e.g. "finger_width"; the option is --finger-width
    std::string symbol;      //!< in formulas, e.g. "w"
    std::string section;     //!< "Element", "Hook", "Cut"
    std::string unit;        //!< "mm" or "deg"
    ParameterRule rule = {}; //!< the default
    double min = 0, max = 0, step = 0;
    std::string help = {}; //!< one line
    double (*get)(const PieceParameters&) = nullptr;
    void (*set)(PieceParameters&, double) = nullptr;
};

//! \brief THE table, in an order in which every rule refers to earlier rows only. Command-line options, Customizer
//! lines, presets and the manual's table are all made from it.
const std::vector<Parameter>& parameter_table();

//! \brief A rule as an expression that C++, OpenSCAD and a maker can read, e.g. "max(3, 0.055 * la)".
std::string to_text(const ParameterRule& rule);

//! \brief "--finger-width" for "finger_width".
std::string option_name(const Parameter& parameter);

//! A parameter by name, in the unit of its row.
using ParameterSetting = std::pair<std::string, double>;

//! \brief The parameters of an element's piece: what \p settings name, and the default rules for all others. A rule
//! sees the settings of earlier rows: a wider finger has a longer finger, a larger hole and a larger lip.
//! \details Refuses unknown names and values outside the row's range. Element rows (la, lb, alpha, thickness) are set
//! by \p element and may be overridden as well.
Expected<PieceParameters> piece_parameters(const Element& element, const std::vector<ParameterSetting>& settings = {});

//! \brief The table as Markdown, for the manual.
std::string parameter_table_markdown();

} // namespace rhombloom
