#include "core/design/mesh_import/import_warning.h"

#include <algorithm>

#include "core/design/mesh_import/mesh_import.h"
#include "core/text.h"

namespace rhombloom {

std::string distance_warning(const Import& import, const Element& element)
{
    constexpr double usual = 0.7; // la; smooth targets end at 0.2 to 0.5
    constexpr int finer = 4;      // times the elements: half the la
    if (!import.distance) {
        return {};
    }
    const double rms = std::max(import.distance->to_target_rms, import.distance->from_target_rms);
    if (rms <= usual * element.la) {
        return {};
    }
    const int more = finer * static_cast<int>(import.quads.size());
    const std::string remedy = more <= most_import_elements
                                   ? "import with --elements " + std::to_string(more) + ", whose la is " +
                                         to_fixed(element.la / 2, 1) + " mm on a target of this size, or make"
                                   : std::string("make");
    return "the elements of " + import.id + " end " + to_fixed(rms / element.la, 2) + " la rms (" + to_fixed(rms, 1) +
           " mm) off their target, expected at most " + to_fixed(usual, 1) +
           " la: parts thinner than two elements and sharp edges are lost; " + remedy + " its thin parts thicker";
}

} // namespace rhombloom
