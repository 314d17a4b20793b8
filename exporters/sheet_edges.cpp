#include "exporters/sheet_edges.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace rhombloom {

std::vector<SheetEdge> sheet_edges(const FlatSheet& sheet, const Element& element)
{
    const int rim = static_cast<int>(sheet.rim);
    std::set<std::pair<int, int>> pairs;
    for (const auto& t : sheet.triangles) {
        for (int k = 0; k < 3; ++k) {
            pairs.insert(std::minmax(t[k], t[(k + 1) % 3]));
        }
    }
    std::vector<SheetEdge> list;
    for (const auto& [a, b] : pairs) {
        const double length = (sheet.points[a] - sheet.points[b]).norm();
        const bool outer = b < rim && (b == a + 1 || (a == 0 && b == rim - 1));
        list.push_back({a, b, length, 0.1 * element.la / std::max(length, 0.01 * element.la), outer});
    }
    return list;
}

double p99_distortion(const BentSurface& bent, const std::vector<SheetEdge>& segments)
{
    std::vector<double> all;
    for (const BentElement& e : bent.elements) {
        for (const SheetEdge& s : segments) {
            all.push_back(std::abs((e.points[s.a] - e.points[s.b]).norm() / s.length - 1));
        }
    }
    const auto p99 = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 99 / 100);
    std::nth_element(all.begin(), p99, all.end());
    return *p99;
}

} // namespace rhombloom
