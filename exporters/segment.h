#pragma once

#include <array>
#include <utility>
#include <vector>

#include "exporters/drawing.h"

namespace rhombloom {

//! \brief One segment of a path: a line, or an arc when bulge is not 0. Places on it are fractions of its length.
struct Segment
{
    Vec2 a = Vec2::Zero();
    Vec2 b = Vec2::Zero();
    double bulge = 0;
};

//! The circle an arc lies on.
struct Circle
{
    Vec2 centre;
    double radius;
};

//! \brief Bent enough to be treated as an arc: under this bulge the sagitta is less than 1e-9 chords.
bool is_arc(const Segment& segment);

//! \brief Included angle, positive counter-clockwise; 0 for a line.
double sweep(const Segment& segment);

//! \pre is_arc(segment)
Circle circle(const Segment& segment);

double length(const Segment& segment);

//! \brief The point at the fraction \p f: exact at both ends, accurate for nearly straight arcs.
Vec2 point(const Segment& segment, double f);

//! \brief Unit tangent at the fraction \p f, in the sense of travel.
Vec2 tangent(const Segment& segment, double f);

//! \brief Where the foot of \p p on the segment's whole line or circle lies, as a fraction; may be outside [0, 1].
double fraction(const Segment& segment, const Vec2& p);

//! \brief Distance of \p p to the segment, mm.
double distance(const Segment& segment, const Vec2& p);

//! \brief The piece from one fraction to another, on the same line or circle.
Segment part(const Segment& segment, double from, double to);

//! \brief The segment made longer or shorter so that it ends (starts) at \p p, which lies on its line or circle.
Segment ending_at(const Segment& segment, const Vec2& p);
Segment starting_at(const Segment& segment, const Vec2& p);

//! \brief Where the whole lines or circles of two segments meet; none when they are parallel, concentric or apart.
std::vector<Vec2> carrier_crossings(const Segment& s, const Segment& t);

//! \brief Where two segments meet, as fractions on each; ends count, within 1e-9 mm. \pre arcs are at most half
//! circles.
std::vector<std::pair<double, double>> crossings(const Segment& s, const Segment& t);

//! A place and the unit tangent there.
struct Heading
{
    Vec2 point;
    Vec2 tangent;
};

//! \brief The pair of arcs that leave and arrive as given and are tangent where they meet; both ends' tangents reach
//! equally far to the common one.
std::array<Segment, 2> biarc(const Heading& from, const Heading& to);

//! \brief A path's segments in order, without those of no length.
std::vector<Segment> segments(const Path& path);

//! \brief The closed path through the starts of \p segments.
Path closed_path(const std::vector<Segment>& segments);

//! \brief No two segments meet but neighbours at their common vertex (closed path; exact test, O(n^2)).
bool is_simple(const Path& path);

} // namespace rhombloom
