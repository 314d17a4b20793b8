#pragma once

#include <string>

#include "exporters/drawing.h"

namespace rhombloom {

//! Line width of every path, mm. Drivers of Epilog, ULS and Trotec machines cut thin lines and engrave thick ones.
struct SvgOptions
{
    double stroke_width = 0.1;
};

//! \brief The drawing as SVG 1.1 for cutting programs.
//! \details The page is in millimetres and one user unit is 1 mm. Coordinates are absolute with y down, arcs are `A`
//! commands, and there is no transform, style sheet, text, fill or reuse. A layer is a group that Inkscape shows as a
//! layer; its paths also carry the layer's colour, because most programs go by colour. The notes are in `<metadata>`.
std::string svg(const Drawing& drawing, const SvgOptions& options = {});

//! \brief "#rrggbb".
std::string colour_text(unsigned rgb);

} // namespace rhombloom
