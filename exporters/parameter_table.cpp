#include "exporters/parameter_table.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace rhombloom {

namespace {

template <double HookParameters::*field>
double get_length(const PieceParameters& p)
{
    return p.hook.*field;
}

template <double HookParameters::*field>
void set_length(PieceParameters& p, double value)
{
    p.hook.*field = value;
}

template <double HookParameters::*field>
double get_angle(const PieceParameters& p)
{
    return degrees(p.hook.*field);
}

template <double HookParameters::*field>
void set_angle(PieceParameters& p, double value)
{
    p.hook.*field = radians(value);
}

template <double Kerf::*field>
double get_kerf(const PieceParameters& p)
{
    return p.kerf.*field;
}

template <double Kerf::*field>
void set_kerf(PieceParameters& p, double value)
{
    p.kerf.*field = value;
}

double get_slit_clearance(const PieceParameters& p)
{
    return p.hook.slit - p.hook.thickness;
}

void set_slit_clearance(PieceParameters& p, double value)
{
    p.hook.slit = p.hook.thickness + value;
}

template <double HookParameters::*field>
Parameter length(const char* name, const char* symbol, const char* section, ParameterRule rule)
{
    Parameter row{name, symbol, section, "mm", std::move(rule)};
    row.get = get_length<field>;
    row.set = set_length<field>;
    return row;
}

template <double HookParameters::*field>
Parameter angle(const char* name, const char* symbol, const char* section, ParameterRule rule)
{
    Parameter row{name, symbol, section, "deg", std::move(rule)};
    row.get = get_angle<field>;
    row.set = set_angle<field>;
    return row;
}

template <double Kerf::*field>
Parameter kerf(const char* name, const char* symbol, ParameterRule rule)
{
    Parameter row{name, symbol, "Cut", "mm", std::move(rule)};
    row.get = get_kerf<field>;
    row.set = set_kerf<field>;
    return row;
}

Parameter slit_clearance()
{
    Parameter row{"slit_clearance", "c", "Hook", "mm", {{}, 0.3}};
    row.get = get_slit_clearance;
    row.set = set_slit_clearance;
    return row;
}

Parameter described(Parameter row, double min, double max, double step, const char* help)
{
    row.min = min;
    row.max = max;
    row.step = step;
    row.help = help;
    return row;
}

std::vector<Parameter> element_rows()
{
    using P = HookParameters;
    return {
        described(length<&P::la>("la", "la", "Element", {{}, 80}), 40, 200, 1, "short side, node to node"),
        described(length<&P::lb>("lb", "lb", "Element", {{{"la", 1.1}}}), 41, 300, 0.5,
                  "long side; 1.05 to 1.15 times la is usual, longer bows more"),
        described(angle<&P::alpha>("alpha", "alpha", "Element", {{}, 63.435}), 50, 80, 0.005,
                  "acute angle; 60, 63.435 and 69 suit most shapes"),
        described(length<&P::thickness>("thickness", "t", "Element", {{}, 0.5}), 0.2, 0.8, 0.05,
                  "of the sheet, measured"),
    };
}

std::vector<Parameter> finger_rows()
{
    using P = HookParameters;
    return {
        described(slit_clearance(), 0.1, 1.5, 0.05, "the slit is this much wider than the sheet is thick"),
        described(length<&P::finger_width>("finger_width", "w", "Hook", {{{"la", 0.055}}, 0, 3}), 2, 25, 0.1,
                  "of finger and root: the master size, the other dimensions follow it"),
        described(length<&P::hole_radius>("hole_radius", "ri", "Hook", {{{"finger_width", 1.2}}}), 2, 40, 0.1,
                  "of the round opening at each node"),
        described(length<&P::finger_length>("finger_length", "e", "Hook", {{{"finger_width", 1.6}}}), 1, 60, 0.1,
                  "of its straight part; longer holds better and bends more easily"),
        described(angle<&P::finger_turn>("finger_turn", "eta", "Hook", {{}, 0}), 0, 15, 0.5,
                  "of finger and slit towards the element, about the slit's bottom"),
    };
}

std::vector<Parameter> long_side_rows()
{
    using P = HookParameters;
    using A = AngleFactor;
    // Capped where the lip would touch the next finger of a node (hook check C6): small pieces of small alpha.
    const ParameterRule lip{{{"thickness", 0.5}, {"slit_clearance", 0.5}, {"finger_width", 0.75}},
                            0,
                            -1e300,
                            {{"hole_radius", 1, A::SineOfAlpha},
                             {"finger_width", 1, A::SineOfAlpha},
                             {"finger_width", -1, A::CosineOfAlpha},
                             {"thickness", -0.5, A::CosineOfAlpha},
                             {"slit_clearance", -0.5, A::CosineOfAlpha}},
                            -0.31};
    const ParameterRule half_slit{{{"thickness", 0.5}, {"slit_clearance", 0.5}}};
    return {
        described(length<&P::lip>("lip", "m", "Hook", lip), 1, 30, 0.1, "how far the long side reaches over a rim"),
        described(length<&P::neck_setback>("neck_setback", "cn", "Hook", half_slit), 0, 3, 0.05,
                  "of the neck behind the nominal long side"),
        described(length<&P::seat_clearance>("seat_clearance", "cs", "Hook", {{}, 0.05}), 0, 0.5, 0.01,
                  "between shoulder and slit bottom"),
        described(length<&P::barb>("barb", "b", "Hook", {{{"finger_width", 0.12}}}), 0, 5, 0.05,
                  "undercut that locks the joint against pulling; 0 for none, card wants 0.6 or more"),
        described(length<&P::lip_rounding>("lip_rounding", "rs", "Hook", {{{"finger_width", 0.35}}}), 0.3, 10, 0.05,
                  "radius of the long side's ends"),
        described(length<&P::scoop_depth>("scoop_depth", "q", "Hook", {{{"la", 0.10}}}), 0, 60, 0.5,
                  "of the soft curve between two hooks"),
        described(length<&P::relief>("relief", "rc", "Hook", {{}, 0}), 0, 2, 0.05,
                  "radius in the corner between neck and shoulder; 0.3 for sheets that tear"),
    };
}

std::vector<Parameter> cut_rows()
{
    return {
        described(kerf<&Kerf::x>("kerf", "k", {{}, 0}), 0, 1, 0.01,
                  "FULL width of the cut; 0 when the machine's program compensates"),
        described(kerf<&Kerf::y>("kerf_y", "ky", {{{"kerf", 1}}}), 0, 1, 0.01,
                  "width of the cut measured along y, when it differs"),
    };
}

std::vector<Parameter> all_rows()
{
    std::vector<Parameter> rows;
    for (const auto& section : {element_rows(), finger_rows(), long_side_rows(), cut_rows()}) {
        rows.insert(rows.end(), section.begin(), section.end());
    }
    return rows;
}

const Parameter* find_row(const std::string& name)
{
    const auto& table = parameter_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const Parameter& p) { return p.name == name; });
    return row == table.end() ? nullptr : &*row;
}

double angle_factor(AngleFactor factor, double alpha)
{
    switch (factor) {
    case AngleFactor::SineOfAlpha:
        return std::sin(alpha);
    case AngleFactor::CosineOfAlpha:
        return std::cos(alpha);
    default:
        return 1;
    }
}

double sum(const std::vector<ParameterTerm>& terms, double constant, const PieceParameters& parameters)
{
    double value = constant;
    for (const ParameterTerm& term : terms) {
        value += term.factor * find_row(term.name)->get(parameters) * angle_factor(term.angle, parameters.hook.alpha);
    }
    return value;
}

double evaluate(const ParameterRule& rule, const PieceParameters& parameters)
{
    const double value = std::max(rule.floor, sum(rule.terms, rule.constant, parameters));
    return rule.cap.empty() ? value : std::min(value, sum(rule.cap, rule.cap_constant, parameters));
}

std::string sum_text(const std::vector<ParameterTerm>& terms, double constant)
{
    std::string text;
    for (const ParameterTerm& term : terms) {
        const std::string sign = text.empty() ? (term.factor < 0 ? "-" : "") : term.factor < 0 ? " - " : " + ";
        const double factor = std::abs(term.factor);
        text += sign + (factor == 1 ? "" : to_text(factor) + " * ") + term.name +
                (term.angle == AngleFactor::SineOfAlpha     ? " * sin(alpha)"
                 : term.angle == AngleFactor::CosineOfAlpha ? " * cos(alpha)"
                                                            : "");
    }
    if (text.empty() || constant > 0) {
        return text + (text.empty() ? "" : " + ") + to_text(constant);
    }
    return constant == 0 ? text : text + " - " + to_text(-constant);
}

Expected<void> check_setting(const ParameterSetting& setting)
{
    const Parameter* row = find_row(setting.first);
    if (!row) {
        std::string known;
        for (const Parameter& p : parameter_table()) {
            known += (known.empty() ? "" : ", ") + p.name;
        }
        return refuse("parameter \"" + setting.first + "\" is unknown: expected one of " + known);
    }
    if (setting.second >= row->min && setting.second <= row->max) {
        return {};
    }
    return refuse("parameter " + row->name + " is " + to_text(setting.second) + " " + row->unit +
                  ": expected a number from " + to_text(row->min) + " to " + to_text(row->max) + " " + row->unit +
                  " (" + row->help + ")");
}

PieceParameters resolved(const Element& element, const std::vector<ParameterSetting>& settings)
{
    PieceParameters parameters;
    parameters.hook.la = element.la;
    parameters.hook.lb = element.lb;
    parameters.hook.alpha = element.alpha;
    parameters.hook.thickness = element.thickness;
    for (const Parameter& row : parameter_table()) {
        const auto set = std::find_if(settings.rbegin(), settings.rend(),
                                      [&](const ParameterSetting& s) { return s.first == row.name; });
        if (set != settings.rend()) {
            row.set(parameters, set->second);
        } else if (row.section != "Element") {
            row.set(parameters, evaluate(row.rule, parameters));
        }
    }
    return parameters;
}

} // namespace

const std::vector<Parameter>& parameter_table()
{
    static const std::vector<Parameter> table = all_rows();
    return table;
}

std::string to_text(const ParameterRule& rule)
{
    std::string text = sum_text(rule.terms, rule.constant);
    text = rule.floor > -1e299 ? "max(" + to_text(rule.floor) + ", " + text + ")" : text;
    return rule.cap.empty() ? text : "min(" + text + ", " + sum_text(rule.cap, rule.cap_constant) + ")";
}

std::string option_name(const Parameter& parameter)
{
    std::string name = "--" + parameter.name;
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

Expected<PieceParameters> piece_parameters(const Element& element, const std::vector<ParameterSetting>& settings)
{
    for (const ParameterSetting& setting : settings) {
        if (auto ok = check_setting(setting); !ok) {
            return tl::make_unexpected(ok.error());
        }
    }
    return resolved(element, settings);
}

HookParameters hook_parameters(const Element& element)
{
    return resolved(element, {}).hook;
}

std::string parameter_table_markdown()
{
    std::string text = "| parameter | symbol | section | default | range | what it is |\n|---|---|---|---|---|---|\n";
    for (const Parameter& row : parameter_table()) {
        text += "| `" + row.name + "` | " + row.symbol + " | " + row.section + " | " + to_text(row.rule) + " | " +
                to_text(row.min) + " to " + to_text(row.max) + " " + row.unit + " | " + row.help + " |\n";
    }
    return text;
}

} // namespace rhombloom
