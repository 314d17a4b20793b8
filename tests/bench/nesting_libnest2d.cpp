// The rival: libnest2d 5.0.0 on convex hulls (it places real concave outlines on top of each other).
#define LIBNEST2D_GEOMETRIES_clipper
#define LIBNEST2D_OPTIMIZER_nlopt
#define LIBNEST2D_THREADING_std
#include <libnest2d/libnest2d.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "exporters/nesting_polygon.h"
#include "tests/bench/nesting_rival.h"

namespace rhombloom {

namespace {

//! libnest2d wants clockwise contours whose last point repeats the first.
libnest2d::Item item_of(const std::vector<Vec2>& outline)
{
    ClipperLib::Path path;
    for (const Vec2& p : nesting::convex_hull(outline)) {
        path.emplace_back(std::llround(p.x() * 1e6), std::llround(p.y() * 1e6));
    }
    std::reverse(path.begin(), path.end());
    path.push_back(path.front());
    path.push_back(path.front());
    return libnest2d::Item(std::move(path));
}

} // namespace

RivalResult libnest2d_on_hulls(const std::vector<Vec2>& outline, const NestOptions& options, RivalStart start)
{
    std::vector<libnest2d::Item> items(static_cast<std::size_t>(options.count), item_of(outline));
    // The bin is a spacing larger, for copies are inflated by half of it on the side of the sheet's edge too.
    const auto side = [&](double size) { return std::llround((size - 2 * options.margin + options.spacing) * 1e6); };
    const libnest2d::Box bin(side(options.sheet_width), side(options.sheet_height));
    libnest2d::NestConfig<> config;
    using Alignment = libnest2d::NestConfig<>::Placement::Alignment;
    const auto where = start == RivalStart::Corner ? Alignment::BOTTOM_LEFT : Alignment::CENTER;
    config.placer_config.alignment = where;
    config.placer_config.starting_point = where;
    config.placer_config.parallel = false;
    RivalResult result;
    result.sheets = static_cast<int>(libnest2d::nest(items, bin, std::llround(options.spacing * 1e6), config));
    std::map<int, int> per_bin;
    for (const auto& item : items) {
        result.per_sheet = std::max(result.per_sheet, ++per_bin[item.binId()]);
    }
    return result;
}

} // namespace rhombloom
