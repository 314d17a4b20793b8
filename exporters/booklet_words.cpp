#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "exporters/booklet_steps.h"

namespace rhombloom {

namespace {

//! The elements joined by the step element's long sides and by its short (hooked) ones.
struct Sides
{
    std::vector<int> by_long;
    std::vector<int> by_short;
};

Sides sides_of(const Surface& surface, Face f, const Step& step, const std::vector<int>& names)
{
    Sides sides;
    for (const Join& join : step.joins) {
        const bool is_long = side(surface, side_halfedge(surface, f, join.side)) == Side::Long;
        (is_long ? sides.by_long : sides.by_short).push_back(names[join.to]);
    }
    return sides;
}

std::string joining(const Sides& sides)
{
    std::string text;
    if (!sides.by_long.empty()) {
        text = sides.by_long.size() == 1 ? "Long side under the hooks of " : "Long sides under the hooks of ";
        text += listed(sides.by_long);
    }
    if (!sides.by_short.empty()) {
        text += text.empty() ? "Its hooks over the long side of " : "; its hooks over the long side of ";
        text += listed(sides.by_short);
    }
    return text.empty() ? "Lay it on the table to begin." : text + ".";
}

std::string parting(const Sides& sides)
{
    std::vector<int> all = sides.by_long;
    all.insert(all.end(), sides.by_short.begin(), sides.by_short.end());
    return listed(all);
}

} // namespace

std::string listed(std::vector<int> names)
{
    std::sort(names.begin(), names.end());
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += i == 0 ? "" : i + 1 == names.size() ? " and " : ", ";
        text += std::to_string(names[i]);
    }
    return text;
}

std::vector<std::string> turn_words(const Turn& turn)
{
    std::vector<std::string> lines;
    if (turn.round != 0) {
        lines.push_back("turn " + to_fixed(std::abs(turn.round), 0) + "\u00B0 " + (turn.round > 0 ? "right" : "left"));
    }
    if (turn.tilt != 0) {
        lines.push_back("tip " + to_fixed(std::abs(turn.tilt), 0) + "\u00B0 " +
                        (turn.tilt > 0 ? "toward you" : "away from you"));
    }
    return lines;
}

std::string step_words(const BookletSources& sources, int k, const std::vector<int>& names)
{
    const Step& step = sources.plan.steps[k];
    const Surface& surface = stage_surface(sources.replay, step.stage);
    const Face f(faces_of_elements(sources.replay, sources.plan, step.stage)[step.element]);
    const Sides sides = sides_of(surface, f, step, names);
    switch (step.kind) {
    case StepKind::Insert:
        return (surface.data(f).facing == Facing::Back ? "Flipped. " : "") + joining(sides) +
               (step.joins.size() == 4 ? " This closes the hole." : "");
    case StepKind::Remove:
        return "Reopen: take out element " + std::to_string(names[step.element]) + ". Unhook it from " +
               parting(sides) + ".";
    case StepKind::Unhook:
        return "Reopen: unhook element " + std::to_string(names[step.element]) + " from " + parting(sides) +
               "; both stay.";
    default:
        return "Close: join element " + std::to_string(names[step.element]) + ". " + joining(sides);
    }
}

} // namespace rhombloom
