#include "core/model/element.h"

#include <cmath>

#include "core/text.h"

namespace rhombloom {

namespace {

struct Limit
{
    const char* name;
    double value;
    double min;
    double max;
    const char* unit;
};

Expected<void> check_limit(const Limit& limit)
{
    // Written so that NaN fails too.
    if (limit.value >= limit.min && limit.value <= limit.max) {
        return {};
    }
    return refuse(std::string(limit.name) + " is " + to_text(limit.value) + " " + limit.unit +
                  ": expected a number from " + to_text(limit.min) + " to " + to_text(limit.max) + " " + limit.unit);
}

} // namespace

double beta(const Element& element)
{
    return pi - element.alpha;
}

double side_length(const Element& element, Side side)
{
    return side == Side::Long ? element.lb : element.la;
}

double short_diagonal(const Element& element)
{
    return std::sqrt(element.la * element.la + element.lb * element.lb -
                     2 * element.la * element.lb * std::cos(element.alpha));
}

double long_diagonal(const Element& element)
{
    return std::sqrt(element.la * element.la + element.lb * element.lb +
                     2 * element.la * element.lb * std::cos(element.alpha));
}

double corner_angle(const Element& element, Side side, Facing facing)
{
    const bool acute = (side == Side::Long) == (facing == Facing::Front);
    return acute ? element.alpha : beta(element);
}

DefectRange permissible_defect(const Element& element)
{
    if (element.defect_limits) {
        return *element.defect_limits;
    }
    return {two_pi - 4 * beta(element) - element.alpha, two_pi - 2 * element.alpha};
}

Expected<void> check(const Element& element)
{
    const Limit limits[] = {
        {"la_mm", element.la, 10, 1000, "mm"},
        {"lb_mm", element.lb, 10, 1500, "mm"},
        {"alpha_deg", degrees(element.alpha), 40, 85, "degrees"},
        {"thickness_mm", element.thickness, 0.05, 5, "mm"},
    };
    for (const Limit& limit : limits) {
        if (auto ok = check_limit(limit); !ok) {
            return ok;
        }
    }
    constexpr double round_off = 1e-9; // 243.3 is 1.5 times 162.2
    const double ratio = element.lb / element.la;
    if (!(ratio > 1 && ratio <= 1.5 + round_off)) {
        return refuse("lb_mm is " + to_text(element.lb) + " mm with la_mm " + to_text(element.la) +
                      " mm: the long side must be longer than the short one, up to 1.5 times (1.1 times is usual)");
    }
    return {};
}

} // namespace rhombloom
