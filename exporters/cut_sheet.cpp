#include "exporters/cut_sheet.h"

#include <algorithm>
#include <cmath>
#include <future>

#include "core/text.h"
#include "exporters/coupon.h"
#include "exporters/cut_drawing.h"
#include "exporters/sha256.h"
#include "exporters/svg.h"
#include "exporters/template_pdf.h"

namespace rhombloom {

namespace {

constexpr int most_pieces = 20000;

struct Limit
{
    const char* name;
    double value;
    double min;
    double max;
};

double stroke_width(const CutOptions& options)
{
    return options.stroke_width.value_or(cut_stroke(options.colours));
}

Expected<void> check(const CutOptions& options, int count)
{
    const Limit limits[] = {
        {"sheet width", options.sheet_width, 50, 5000},
        {"sheet height", options.sheet_height, 50, 5000},
        {"margin", options.margin, 0, 500},
        {"spacing", options.spacing, 0, 200},
        {"kerf in x", options.kerf_x, 0, 2},
        {"kerf in y", options.kerf_y, 0, 2},
        {"share of spares", options.spares, 0, 1},
        {"stroke width", stroke_width(options), 0.001, 2},
        {"cutting speed", options.speeds.cut, 0.01, 10000},
        {"engraving speed", options.speeds.engrave, 0.01, 10000},
        {"travel speed", options.speeds.travel, 0.01, 100000},
        {"acceleration", options.speeds.acceleration, 1, 1e6},
        {"time to pierce", options.speeds.pierce, 0, 1000},
        {"density", options.density, 0.01, 30},
        {"price per sheet", options.price_per_sheet, 0, 1e6},
        {"price per minute", options.price_per_minute, 0, 1e6},
        {"number of pieces", static_cast<double>(count), 1, most_pieces},
    };
    for (const Limit& limit : limits) {
        if (!(limit.value >= limit.min && limit.value <= limit.max)) { // false for NaN
            return refuse("the " + std::string(limit.name) + " is " + to_text(limit.value) + ": expected " +
                          to_text(limit.min) + " to " + to_text(limit.max));
        }
    }
    const double kerf = std::max(options.kerf_x, options.kerf_y);
    if (options.spacing < kerf) {
        return refuse("the spacing is " + to_text(options.spacing) + " mm and the kerf " + to_text(kerf) +
                      " mm: pieces would be cut into; give at least the kerf, better 2 mm");
    }
    return {};
}

//! Of the outline that is nested, mm: no gap is larger than it must be by more than twice that.
double flatten_tolerance(const HookParameters& parameters)
{
    return parameters.la / 8000;
}

Expected<Nesting> lay_out(const Path& outline, double tolerance, int count, const CutOptions& options)
{
    NestOptions nest_options;
    nest_options.sheet_width = options.sheet_width;
    nest_options.sheet_height = options.sheet_height;
    // Chords lie inside of arcs: the true gap is smaller by up to twice the tolerance.
    nest_options.spacing = options.spacing + 2 * tolerance;
    nest_options.margin = std::max(options.margin, std::max(options.kerf_x, options.kerf_y) / 2) + tolerance;
    nest_options.count = count;
    nest_options.grain = options.grain;
    nest_options.effort = Effort::SaveSheets;
    if (options.remnant) {
        nest_options.remnant = Vec2(options.remnant->width, options.remnant->height);
    }
    return nest(flatten(outline, tolerance), nest_options);
}

std::string two_digits(std::size_t number)
{
    return (number < 10 ? "0" : "") + std::to_string(number);
}

//! Of the i-th piece, which is a spare from \p elements on.
std::string piece_label(int i, int elements)
{
    return i < elements ? std::to_string(i + 1) : "S" + std::to_string(i - elements + 1);
}

//! The marks turned by half about the piece's centre if they would stand on their head on the sheet.
std::vector<Path> upright(std::vector<Path> marks, const HookParameters& parameters, const Placement& placement)
{
    if (std::cos(placement.angle) < -1e-9) {
        for (Path& mark : marks) {
            mark = placed(mark, pi, 2 * piece_centre(parameters));
        }
    }
    return marks;
}

//! Everything about a job that its sheets share.
struct Job
{
    const Element& element;
    const HookParameters& parameters;
    const CutOptions& options;
    Path outline;
    Blank blank;
    int elements;
    int spares;
};

std::string mm(double value)
{
    return to_text(value) + " mm";
}

std::string speeds_text(const Speeds& speeds)
{
    return "cutting " + to_text(speeds.cut) + " mm/s, engraving " + to_text(speeds.engrave) + " mm/s, travel " +
           to_text(speeds.travel) + " mm/s, acceleration " + to_text(speeds.acceleration) + " mm/s2, " +
           to_text(speeds.pierce) + " s per start";
}

//! Tells apart files of elements that look alike.
std::string checksum(const Path& outline)
{
    std::string text;
    for (const PathVertex& v : outline.vertices) {
        text += to_fixed(v.point.x(), 4) + " " + to_fixed(v.point.y(), 4) + " " + to_fixed(v.bulge, 4) + "\n";
    }
    return sha256(text).substr(0, 16);
}

std::string kerf_text(const CutOptions& options)
{
    if (options.kerf_x == 0 && options.kerf_y == 0) {
        return "0 mm, the lines are the finished edges; let the cutting program compensate";
    }
    return mm(options.kerf_x) + " in x, " + mm(options.kerf_y) +
           " in y, full width, compensated in this file; do not compensate again";
}

//! Recorded in every file.
std::vector<std::string> settings(const Job& job)
{
    const Element& e = job.element;
    std::vector<std::string> notes = {
        "made with: rhombloom",
        "units: 1 = 1 mm",
        "element: la " + mm(e.la) + ", lb " + mm(e.lb) + ", alpha " + to_fixed(degrees(e.alpha), 4) +
            " deg, thickness " + mm(e.thickness) + ", outline " + checksum(job.outline),
        "machine: " + (job.options.machine.empty() ? "any" : job.options.machine),
        "margin: " + mm(job.options.margin),
        "spacing: " + mm(job.options.spacing) + " between finished edges",
        "kerf: " + kerf_text(job.options),
        "order: engrave, inner, outer",
        "layers: " + layers_text(job.options),
    };
    notes.insert(notes.end(), job.options.notes.begin(), job.options.notes.end());
    return notes;
}

Expected<Drawing> sheet_drawing(Job& job, const Nesting& nesting, std::size_t index, int first)
{
    const Sheet& sheet = nesting.sheets[index];
    std::vector<LaidPiece> pieces;
    std::vector<std::string> ids;
    for (const Placement& placement : sheet.placements) {
        const std::string label = piece_label(first + static_cast<int>(ids.size()), job.elements);
        auto piece = job.blank.laid(placement);
        if (!piece) {
            return tl::make_unexpected(piece.error());
        }
        if (job.options.engraving == Engraving::On) {
            piece->engraved = laid(upright(front_marks(job.parameters, label), job.parameters, placement), placement);
        }
        pieces.push_back(std::move(*piece));
        ids.push_back("element-" + label);
    }
    Drawing drawing = cut_drawing(pieces, ids, {sheet.width, sheet.height}, job.options);
    drawing.notes = settings(job);
    drawing.notes.push_back("sheet: " + std::to_string(index + 1) + " of " + std::to_string(nesting.sheets.size()) +
                            ", " + to_text(sheet.width) + " x " + to_text(sheet.height) + " mm, " +
                            std::to_string(pieces.size()) + " pieces");
    return drawing;
}

void add_drawing(FileSet& files, const std::string& name, const Drawing& drawing, const CutOptions& options)
{
    files["cut/" + name + ".svg"] = svg(drawing, {stroke_width(options)});
    files["cut/" + name + ".dxf"] = dxf(drawing, options.dxf);
}

void add_work(CutReport& report, const CutWork& work)
{
    report.cut_length_m += work.cut / 1000;
    report.engrave_length_m += work.engrave / 1000;
    report.travel_m += work.travel / 1000;
    report.pierces += work.pierces;
    report.minutes += work.seconds / 60;
}

CutReport first_report(const Job& job, const Nesting& nesting)
{
    CutReport report;
    report.elements = job.elements;
    report.spares = job.spares;
    report.sheets = static_cast<int>(nesting.sheets.size());
    report.utilisation = nesting.utilisation;
    report.speeds = job.options.speeds;
    report.speeds_text = speeds_text(report.speeds);
    report.layers_text = layers_text(job.options);
    const double volume = std::abs(area(job.outline)) * job.parameters.thickness * (job.elements + job.spares);
    report.mass_g = volume * job.options.density / 1000;
    const Vec2 left = nesting.sheets.back().offcut.max - nesting.sheets.back().offcut.min;
    report.remnant = left.minCoeff() > 0 ? SheetSize{left.x(), left.y()} : SheetSize{};
    return report;
}

void add_cost(CutReport& report, const CutOptions& options)
{
    if (options.price_per_sheet > 0 || options.price_per_minute > 0) {
        report.cost = report.sheets * options.price_per_sheet + report.minutes * options.price_per_minute;
    }
}

void add_coupon(CutDrawings& result, const Job& job)
{
    auto strips = coupon(job.parameters, job.options);
    if (!strips) {
        result.report.warnings.push_back(strips.error().message);
        return;
    }
    result.coupon = std::move(strips->drawing);
    result.coupon->notes = settings(job);
    result.coupon->notes.push_back(
        "coupon: pairs of strips with 1, 2, ... notches, each for another kerf; the square for none");
    result.report.coupon_text = strips->text;
    if (!strips->warning.empty()) {
        result.report.warnings.push_back(strips->warning);
    }
}

Expected<void> add_sheets(CutDrawings& result, Job& job, const Nesting& nesting)
{
    int first = 0;
    for (std::size_t i = 0; i < nesting.sheets.size(); ++i) {
        auto drawing = sheet_drawing(job, nesting, i, first);
        if (!drawing) {
            return tl::make_unexpected(drawing.error());
        }
        add_work(result.report, cut_work(*drawing, job.options.speeds));
        result.sheets.push_back(std::move(*drawing));
        first += static_cast<int>(nesting.sheets[i].placements.size());
    }
    add_cost(result.report, job.options);
    return {};
}

} // namespace

void use_machine(CutOptions& options, const Machine& machine)
{
    options.machine = machine.name;
    options.sheet_width = machine.width;
    options.sheet_height = machine.height;
    options.margin = machine.margin;
    options.colours = machine.colours;
    options.annotations = machine.annotations;
    options.dxf = machine.dxf;
    options.speeds = machine.speeds;
}

Expected<CutDrawings> cut_drawings(const Element& element, const HookParameters& parameters, int count,
                                   const CutOptions& options)
{
    if (auto ok = check(options, count); !ok) {
        return tl::make_unexpected(ok.error());
    }
    auto outline = element_outline(parameters);
    if (!outline) {
        return tl::make_unexpected(outline.error());
    }
    const int spares = static_cast<int>(std::ceil(count * options.spares - 1e-9));
    const Kerf kerf = {options.kerf_x, options.kerf_y};
    Job job = {element, parameters, options, *outline, Blank(*outline, kerf), count, spares};
    const auto nesting = lay_out(job.outline, flatten_tolerance(parameters), count + spares, options);
    if (!nesting) {
        return tl::make_unexpected(nesting.error());
    }
    CutDrawings result = {{}, {}, first_report(job, *nesting)};
    if (auto ok = add_sheets(result, job, *nesting); !ok) {
        return tl::make_unexpected(ok.error());
    }
    add_coupon(result, job);
    return result;
}

Expected<CutFiles> cut_files(const Element& element, const HookParameters& parameters, int count,
                             const CutOptions& options)
{
    // The template nests its own pages: on a thread of its own, beside the sheets.
    auto template_made = std::async(std::launch::async, [&] {
        return element_outline(parameters).and_then([&](const Path& outline) {
            return template_pdf(outline, options.paper);
        });
    });
    auto drawings = cut_drawings(element, parameters, count, options);
    auto pdf = template_made.get();
    if (!drawings) {
        return tl::make_unexpected(drawings.error());
    }
    CutFiles result = {{}, std::move(drawings->report)};
    for (std::size_t i = 0; i < drawings->sheets.size(); ++i) {
        add_drawing(result.files, "sheet-" + two_digits(i + 1), drawings->sheets[i], options);
    }
    if (drawings->coupon) {
        add_drawing(result.files, "coupon", *drawings->coupon, options);
    }
    if (!pdf) {
        return tl::make_unexpected(pdf.error());
    }
    result.files["cut/template-1to1.pdf"] = std::move(*pdf);
    return result;
}

} // namespace rhombloom
