#pragma once

#include <string>

#include "core/expected.h"
#include "exporters/drawing.h"

namespace rhombloom {

//! \brief An outline from a file: one closed contour of lines and circular arcs, mm, y up.
struct ReadOutline
{
    Path path;
    double strayed = 0; //!< mm; other curves (Bezier, elliptic) became chords that keep within this of them
};

//! \brief Read the one contour in an SVG, DXF or JSON file; the name's ending tells which.
//! \details SVG: paths, polygons, polylines, lines, rectangles, circles and ellipses, with transforms; in mm by width,
//! height and viewBox. DXF (ASCII): LWPOLYLINE, POLYLINE, LINE, ARC and CIRCLE, in mm by $INSUNITS. JSON:
//! {"outline": [[x, y], ...]} in mm, a third number being a bulge as in DXF. Loose segments are joined where ends are
//! within 0.01 mm. Refuses what is malformed, empty, open, or more than one contour; not what crosses itself.
Expected<ReadOutline> read_outline(const std::string& file_name, const std::string& bytes);

} // namespace rhombloom
