#include "exporters/hook_checks.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "exporters/hook_measures.h"
#include "exporters/segment.h"

namespace rhombloom {

namespace {

std::string mm(double value)
{
    return to_fixed(value, 2) + " mm";
}

std::string percent(double value)
{
    return to_fixed(value, 2) + " %";
}

std::string deg(double angle)
{
    return to_fixed(degrees(angle), 1) + " degrees";
}

//! What a check found; the remedy is said only when it failed.
struct Finding
{
    bool ok;
    double value;
    double limit;
    std::string fact;
    std::string remedy;
};

HookCheck entry(const char* id, const char* name, const char* unit, const Finding& found)
{
    return {
        id, name, found.ok, found.value, found.limit, unit, found.fact + (found.ok ? "." : "; " + found.remedy + ".")};
}

//! From a node to the far end of the finger, beyond the slit's bottom: the straight part and half the tip.
double engagement(const HookParameters& p)
{
    return p.finger_length + p.finger_width / 2;
}

double bowed_length(const HookParameters& p)
{
    return p.lb - 2 * pivot_radius(p);
}

double bowed_chord(const HookParameters& p)
{
    return p.la - 2 * pivot_radius(p);
}

HookCheck contour(const Path& outline)
{
    const bool ok = is_simple(outline) && area(outline) > 0;
    return entry("C1", "contour", "mm2",
                 {ok, area(outline), 0,
                  "the contour of " + to_fixed(area(outline), 0) + " mm2 " +
                      (ok ? "is simple and counter-clockwise" : "crosses itself"),
                  "make the finger width smaller or the acute angle larger"});
}

HookCheck web(const HookParameters& p, const Path& outline)
{
    const double limit = std::max(1.5, 3 * p.thickness);
    const double value = narrowest_web(p, outline);
    return entry("C2", "narrowest web", "mm",
                 {value >= limit, value, limit,
                  "the narrowest web is " + mm(value) + ", at least " + mm(limit) + " (3 sheets, 1.5 mm) holds",
                  "make the finger width larger"});
}

HookCheck throat(const HookParameters& p, double finger_strain_limit)
{
    const double limit = 0.1;
    const double clearance = p.slit - p.thickness;
    const double lift = 3 * std::pow(p.thickness / engagement(p), 2);
    const double flat_slope = 2 * std::atan2(p.thickness, p.slit);
    const std::string threading = "it threads without flexing from a slope of " + deg(flat_slope) +
                                  ", else the finger lifts by " + mm(2 * p.thickness) + " with a strain of " +
                                  percent(100 * lift);
    return entry("C3", "throat", "mm",
                 {clearance >= limit - 1e-9 && lift <= finger_strain_limit, clearance, limit,
                  "the slit of " + mm(p.slit) + " leaves " + mm(clearance) + " beside a sheet of " + mm(p.thickness) +
                      " (" + mm(limit) + " needed); " + threading,
                  "make the slit clearance or the finger length larger"});
}

HookCheck kerf(const HookParameters& p, const Path& outline, const Kerf& width)
{
    const double left = p.slit - std::max(width.x, width.y);
    const auto path = tool_path(outline, width);
    const std::string fact = "a slit of " + mm(p.slit) + " with a kerf of " + mm(std::max(width.x, width.y)) + " ";
    const std::string how = !path                 ? "cannot be cut"
                            : path->slits.empty() ? "leaves " + mm(left) + " between its two passes"
                                                  : "is cut in one pass as wide as the kerf";
    return entry("C4", "kerf", "mm",
                 {path.has_value(), left, narrowest_slit, fact + how, path ? "" : path.error().message});
}

HookCheck engagement_check(const HookParameters& p)
{
    const double limit = std::max(3 * p.thickness, 3.0);
    const double over_rim = p.lip - p.slit / 2 - engagement(p) * std::sin(p.finger_turn);
    const bool ok = engagement(p) >= limit && over_rim >= 2 * p.thickness;
    return entry(
        "C5", "engagement", "mm",
        {ok, engagement(p), limit,
         "the finger reaches " + mm(engagement(p)) + " over its neighbour (" + mm(limit) + " needed) and the lip " +
             mm(over_rim) + " over the rim at the tip (" + mm(2 * p.thickness) + " needed)",
         engagement(p) >= limit ? "make the lip larger or the finger turn smaller" : "make the finger length larger"});
}

HookCheck node_clearance(const HookParameters& p)
{
    const double value = pivot_radius(p) * std::sin(p.alpha) - (p.finger_width + p.slit / 2) * std::cos(p.alpha);
    const double limit = p.lip + 0.3;
    return entry("C6", "clearance at a node", "mm",
                 {value >= limit, value, limit,
                  "a finger passes the next long side at " + mm(value) + ", its lip needs " + mm(limit),
                  "make alpha or the hole radius larger, or the lip smaller"});
}

HookCheck corner(const HookParameters& p)
{
    const double finger = std::asin(std::min(1.0, (p.finger_width + p.slit / 2) / (pivot_radius(p) + p.slit / 2)));
    const double neck = 2 * pivot_radius(p) * std::sin(p.alpha / 2);
    const double limit = 1.5 * p.finger_width;
    return entry("C7", "room in the acute corner", "mm",
                 {finger < p.alpha && neck >= limit, neck, limit,
                  "the neck of the acute corner is " + mm(neck) + " wide (" + mm(limit) +
                      " needed) and a finger takes " + deg(finger) + " of its " + deg(p.alpha),
                  "make the hole radius or alpha larger"});
}

HookCheck tips_apart(const HookParameters& p)
{
    const double reach = pivot_radius(p) + p.slit / 2 + p.finger_length * std::cos(p.finger_turn) + p.finger_width / 2;
    const double value = p.la - 2 * reach;
    const double limit = 0.3 * p.la;
    return entry("C8", "finger tips apart", "mm",
                 {value >= limit, value, limit,
                  "the finger tips of a side are " + mm(value) + " apart, 0.3 la = " + mm(limit) + " needed",
                  "make the finger width or the finger length smaller, or la larger"});
}

//! The longest lb, in tenths of a millimetre, with which the long side is less than \p limit times its chord.
double bowing_lb(const HookParameters& p, double limit)
{
    const double most = p.lb - bowed_length(p) + limit * bowed_chord(p);
    return std::ceil(10 * most - 1) / 10;
}

HookCheck bow_check(const HookParameters& p)
{
    const double limit = 1.5;
    const double ratio = bowed_length(p) / bowed_chord(p);
    const bool ok = p.la < p.lb && ratio > 1 && ratio < limit;
    std::string fact = "between the slits the long side is " + to_fixed(ratio, 3) + " times its chord";
    if (ok) {
        const Bow b = bow(bowed_length(p), bowed_chord(p));
        fact += ": it bows by " + mm(b.sagitta) + " with a radius of " + mm(b.radius) + " and ends at " + deg(b.slope);
    }
    return entry("C9", "bow", "",
                 {ok, ratio, limit, fact + " (under 1.5 needed)",
                  ok ? ""
                  : p.la >= p.lb
                      ? "make lb longer than la"
                      : "make lb shorter (" + mm(bowing_lb(p, limit)) + " would do) or the hole radius smaller"});
}

//! Bending strains, 1 = 100 %: bowed, one end inserted beside its slit, finger hugging the bow.
struct Strains
{
    double bowed;
    double inserted;
    double finger;
};

Strains strains(const HookParameters& p)
{
    const double inserted_chord = bowed_chord(p) - engagement(p) - p.slit / 2;
    if (bowed_length(p) <= bowed_chord(p) || inserted_chord <= 0) {
        return {1, 1, 1};
    }
    const Bow rest = bow(bowed_length(p), bowed_chord(p));
    const Bow insertion = bow(bowed_length(p), inserted_chord);
    return {p.thickness / (2 * rest.radius), p.thickness / (2 * insertion.radius),
            p.thickness * rest.slope / (2 * engagement(p))};
}

//! The finger length that takes the strain down by \p excess, in tenths of a millimetre: strain falls as 1/engagement.
double bearing_finger_length(const HookParameters& p, double excess)
{
    return std::ceil(10 * (p.finger_length + engagement(p) * (excess - 1))) / 10;
}

HookCheck strain(const HookParameters& p, const HookCheckOptions& options)
{
    const Strains s = strains(p);
    const double side = std::max(s.bowed, s.inserted);
    const bool side_ok = side <= options.strain_limit;
    const bool finger_ok = s.finger <= options.finger_strain_limit;
    const bool finger_is_worse = s.finger / options.finger_strain_limit > side / options.strain_limit;
    return entry("C10", "bending strain", "%",
                 {side_ok && finger_ok, 100 * (finger_is_worse ? s.finger : side),
                  100 * (finger_is_worse ? options.finger_strain_limit : options.strain_limit),
                  "the sheet is strained by " + percent(100 * s.bowed) + " when bowed and " +
                      percent(100 * s.inserted) + " while an end is inserted (it bears " +
                      percent(100 * options.strain_limit) + "), and by " + percent(100 * s.finger) +
                      " in the fingers (" + percent(100 * options.finger_strain_limit) + ")",
                  side_ok ? "make the finger length larger, lb shorter or the sheet thinner; a finger length of " +
                                mm(bearing_finger_length(p, s.finger / options.finger_strain_limit)) + " would bear it"
                          : "make lb shorter or the sheet thinner"});
}

HookCheck flip(const HookParameters& p, const Path& outline)
{
    const double value = flip_mismatch(p, outline);
    return entry("C11", "turned-over pieces", "mm",
                 {value <= 1e-6, value, 1e-6,
                  "the hooks of a front piece and a back piece at one node differ by " + to_fixed(value, 6) + " mm",
                  "the hooks of acute and obtuse corners must be alike"});
}

//! The largest travel sideways and outwards; outwards only when a barb is to hold there.
double travel_sideways(const Interlock& lock, bool has_barb)
{
    constexpr std::size_t outwards = 90 / 15;
    constexpr std::size_t inwards = 270 / 15;
    double worst = 0;
    for (std::size_t i = 0; i < lock.travel.size(); ++i) {
        worst = i == inwards || (i == outwards && !has_barb) ? worst : std::max(worst, lock.travel[i]);
    }
    return worst;
}

HookCheck certificate(const HookParameters& p, const Path& outline)
{
    const Interlock lock = interlock(p, outline);
    const double limit = 0.5;
    const double limit_inwards = std::max(limit, p.slit + p.relief);
    const double value = travel_sideways(lock, p.barb > 0);
    const double inwards = lock.travel[270 / 15];
    const bool rest = lock.fingers == 2 && lock.lips == 2 && !lock.crossed;
    const std::string overlaps = std::to_string(lock.fingers) + " fingers over and " + std::to_string(lock.lips) +
                                 " lips over the neighbour" + (lock.crossed ? ", and some are both" : "");
    const std::string travel = "it can move by " + mm(value) + " sideways or outwards before it is blocked (" +
                               mm(limit) + " allowed) and by " + mm(inwards) + " inwards (" + mm(limit_inwards) +
                               " allowed)";
    const std::string remedy = !rest           ? "make the slit, the neck setback or the seat clearance larger"
                               : value > limit ? "make the barb larger or the seat clearance smaller"
                                               : "make the neck setback smaller";
    return entry("C12", "interlock", "mm",
                 {rest && value <= limit && inwards <= limit_inwards, value, limit,
                  "an edge has " + overlaps + " (2 and 2 needed); " + travel +
                      (p.barb > 0 ? "" : ", without a barb freely outwards"),
                  remedy});
}

Path polygon(const std::vector<Vec2>& points)
{
    Path path;
    for (const Vec2& point : points) {
        path.vertices.push_back({point, 0});
    }
    return path;
}

HookCheck bowed(const HookParameters& p, const Path& outline)
{
    const Path plan = polygon(bowed_plan(p, outline));
    const bool ok = is_simple(plan);
    return entry("C13", "bowed plan view", "mm2",
                 {ok, area(plan), 0,
                  std::string("seen from above the bowed piece ") + (ok ? "is simple" : "crosses itself"),
                  "make the scoop depth or the finger width smaller"});
}

} // namespace

std::vector<HookCheck> hook_checks(const HookParameters& parameters, const HookCheckOptions& options)
{
    const auto outline = element_outline(parameters);
    if (!outline) {
        return {{"C1", "contour", false, 0, 0, "mm2", outline.error().message + "."}};
    }
    return {contour(*outline),
            web(parameters, *outline),
            throat(parameters, options.finger_strain_limit),
            kerf(parameters, *outline, options.kerf),
            engagement_check(parameters),
            node_clearance(parameters),
            corner(parameters),
            tips_apart(parameters),
            bow_check(parameters),
            strain(parameters, options),
            flip(parameters, *outline),
            certificate(parameters, *outline),
            bowed(parameters, *outline)};
}

Expected<void> check(const HookParameters& parameters, const HookCheckOptions& options)
{
    for (const HookCheck& found : hook_checks(parameters, options)) {
        if (!found.ok) {
            return refuse("hook check " + found.id + " (" + found.name + "): " + found.sentence);
        }
    }
    return {};
}

} // namespace rhombloom
