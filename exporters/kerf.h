#pragma once

#include "core/expected.h"
#include "exporters/drawing.h"

namespace rhombloom {

//! \brief FULL width of the cut, mm, measured along x and along y; equal for most machines. 0: none.
struct Kerf
{
    double x = 0;
    double y = 0;
};

//! \brief What the tool's centre follows so that the finished edge is the nominal one.
struct ToolPath
{
    Path contour;            //!< closed, same sense as the nominal contour
    std::vector<Path> slits; //!< open lines, for slits that one pass cuts; they belong on the inner layer
};

//! \brief Move a closed contour by half the kerf away from its material, which lies to the left: a counter-clockwise
//! contour grows, a clockwise one (a hole) shrinks.
//! \details The exact Minkowski sum with a disc of the kerf's diameter: lines shift, arcs stay arcs with another
//! radius, convex corners get an arc, concave corners the intersection. With different kerfs in x and y the disc is
//! an ellipse and arcs become pairs of arcs within #kerf_tolerance. Segments
//! shorter than #shortest_segment are left out, their neighbours meeting in a mitre, or are merged into a neighbour. A
//! kerf of 0 in one direction only counts as 0.001 mm.
//! Runs of lines shorter than that in the contour itself are simplified first, within 0.002 mm.
//!
//! A slit is a gap between two parallel lines joined at one end by a half circle or a line. When it is no wider than
//! the kerf it becomes one open line along its middle, which cuts it as wide as the kerf; when it is wider by less
//! than #narrowest_slit both its edges would be cut in the same place and the contour is refused. Refused too: any
//! other gap that the kerf would close deeper than its own width; the sentence names the place.
//! \pre The contour is simple.
Expected<ToolPath> tool_path(const Path& contour, const Kerf& kerf);

//! mm; segments shorter than this are lost or stall the machine in laser programs.
inline constexpr double shortest_segment = 0.05;
//! mm, between the two passes along a slit.
inline constexpr double narrowest_slit = 0.05;
//! mm, of the arcs that stand for elliptic ones, where they need not be shorter than the shortest segment for it.
inline constexpr double kerf_tolerance = 0.0001;

} // namespace rhombloom
