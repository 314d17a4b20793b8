// How many copies a sheet takes: rhombloom beside libnest2d. Arguments: none, or the names of outlines to run.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "exporters/nesting_polygon.h"
#include "exporters/outline.h"
#include "tests/bench/nesting_rival.h"
#include "tests/exporters/nesting_outlines.h"

namespace {

using namespace rhombloom;

struct NamedOutline
{
    std::string name;
    outlines::Outline outline;
};

NamedOutline element(double la, double lb, double alpha, double thickness)
{
    const Element element{.la = la, .lb = lb, .alpha = radians(alpha), .thickness = thickness};
    return {"la " + std::to_string(std::lround(la)) + " a " + std::to_string(std::lround(alpha)),
            outline_points(hook_parameters(element), 48).value()};
}

std::vector<NamedOutline> all_outlines()
{
    return {{"element 80/88", outlines::from_data("nest_default_element.json")},
            {"piece A", outlines::from_data("nest_piece_a.json")},
            element(40, 44, 52, 0.3),
            element(48, 56, 76, 0.25),
            element(60, 66, 69, 0.3),
            element(70, 84, 58, 0.5),
            element(100, 110, 72, 0.8),
            element(120, 132, 63.435, 0.5),
            {"L", outlines::l_shape()},
            {"T", outlines::tee()},
            {"U", outlines::u_shape()},
            {"star", outlines::star(5, 42, 17)},
            {"triangle", outlines::triangle()},
            {"arrow", outlines::arrow()},
            {"hexagon", outlines::regular(6, 32)},
            {"pentagon", outlines::regular(5, 32)},
            {"crescent", outlines::crescent(100)},
            {"rectangle", outlines::rectangle(71, 43)},
            {"concave 1", outlines::random_concave(1)},
            {"concave 2", outlines::random_concave(2)},
            {"concave 3", outlines::random_concave(3)},
            {"concave 4", outlines::random_concave(4)}};
}

double seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

NestOptions options_for(const outlines::Outline& outline, double width, double height)
{
    NestOptions options;
    options.sheet_width = width;
    options.sheet_height = height;
    // Enough copies to fill one sheet, even at full density.
    options.count = static_cast<int>(width * height / std::abs(nesting::signed_area(outline))) + 1;
    return options;
}

void run(const NamedOutline& named, double width, double height)
{
    const NestOptions options = options_for(named.outline, width, height);
    const double start = seconds();
    const auto ours = nest(named.outline, options);
    const double middle = seconds();
    const RivalResult corner = libnest2d_on_hulls(named.outline, options, RivalStart::Corner);
    const RivalResult centre = libnest2d_on_hulls(named.outline, options, RivalStart::Centre);
    const double end = seconds();
    const int rival = std::max(corner.per_sheet, centre.per_sheet);
    if (!ours) {
        std::printf("%-14s %4.0fx%-4.0f %s\n", named.name.c_str(), width, height, ours.error().message.c_str());
        return;
    }
    std::printf("%-14s %4.0fx%-4.0f %6d %9d %9d %+8.0f %% %8.2f s %8.2f s\n", named.name.c_str(), width, height,
                ours->per_sheet, corner.per_sheet, centre.per_sheet, 100.0 * (ours->per_sheet - rival) / rival,
                middle - start, end - middle);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> wanted(argv + 1, argv + argc);
    std::printf("copies on one sheet, 2 mm spacing, no margin; CPU time\n");
    std::printf("%-14s %-9s %6s %9s %9s %10s %10s %10s\n", "outline", "sheet", "ours", "libnest2d", "(centre)", "ahead",
                "ours", "libnest2d");
    for (const NamedOutline& named : all_outlines()) {
        if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), named.name) == wanted.end()) {
            continue;
        }
        for (const auto& [width, height] : {std::pair{600.0, 400.0}, {300.0, 200.0}, {495.0, 279.0}, {297.0, 210.0}}) {
            run(named, width, height);
        }
    }
    return 0;
}
