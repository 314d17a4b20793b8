#pragma once

#include "core/model/element.h"
#include "exporters/drawing.h"

namespace rhombloom {

//! \brief All dimensions of the flat piece (mm, radians): the element's and those of its four hooks.
//! \details A zero-initialised hook dimension means nothing: start from hook_parameters() and change what you like.
struct HookParameters
{
    double la = 80, lb = 88, alpha = radians(63.435), thickness = 0.5;
    double slit = 0;           //!< throat s
    double finger_width = 0;   //!< w, the master size
    double hole_radius = 0;    //!< ri, round each node
    double finger_length = 0;  //!< e, straight part
    double finger_turn = 0;    //!< eta, finger and slit turned towards the element about the slit's bottom
    double lip = 0;            //!< m, how far the long side stands out over the nominal side
    double neck_setback = 0;   //!< cn, how far the neck lies inside the nominal long side
    double seat_clearance = 0; //!< cs, between the long side's shoulder and the slit's bottom
    double barb = 0;           //!< b, undercut of the shoulder; 0: the joint can be pulled apart in its plane
    double lip_rounding = 0;   //!< rs
    double scoop_depth = 0;    //!< q, of the soft curve between two hooks, below the nominal short side
    double relief = 0;         //!< radius in the corner between neck and shoulder; 0: sharp, as in the reference
};

//! \brief The default proportions for an element: the rules of the parameter table (parameter_table.h).
HookParameters hook_parameters(const Element& element);

//! \brief Rp = ri + w, from a node to the slit's bottom: la and lb each lose it at both ends when hooked.
double pivot_radius(const HookParameters& parameters);

//! \brief The contour of the flat piece, counter-clockwise, lines and arcs; corner v0 (acute) in the origin and the
//! long side v0-v1 on the x axis. Acute corners at v0 and v2, hooks on the short sides v1-v2 and v3-v0.
//!
//! \details The contour in closed form, so that it can be written again in any language. Each side has a frame with
//! its origin in the side's first corner, u along the side and o OUTWARD (to the right of u). With
//! `Rp = ri + w`, `cb = (Rp + s/2, 0)`, `d = (cos eta, -sin eta)`, `n = (sin eta, cos eta)` and a vertex written as
//! point : bulge, where bulges are those of the counter-clockwise contour (positive = convex):
//!
//! Half a long side, corner to middle (the other half is its mirror image u -> lb - u in reverse order):
//! 1. `(sqrt(ri^2 - h^2), -h) : 0` with `h = cn + relief`, where the hole ends and the neck begins;
//! 2. relief > 0: `(Rp + cs - relief, -h) : -tan(pi/8)`, `(Rp + cs, -cn) : 0`; relief = 0: `(Rp + cs, -cn) : 0`;
//! 3. barb > 0: the concave corner C = (Rp + cs, 0) turns by `theta = atan2(b, m - rs)` and is rounded with radius
//!    `r = max(0.3, 0.2 + 0.06/theta)`, tangent length `k = r tan(theta/2)`:
//!    `C - k (0, 1) : -tan(theta/4)`, `C + k (-sin theta, cos theta) : 0`;
//! 4. `(Rp + cs - b, m - rs) : tan(pi/8)`, `(Rp + cs - b + rs, m) : 0`.
//!
//! Half a short side, corner to middle (mirror image u -> la - u in reverse order):
//! 1. `(ri, 0) : tan((pi/2 + eta)/4)`, the root's outside; 2. `cb + (s/2 + w) n : 0`, the finger's outside;
//! 3. `cb + e d + (s/2 + w) n : 1`, the tip; 4. `cb + e d + s/2 n : 0`, the slit's far edge;
//! 5. `cb + s/2 n : -1`, the slit's bottom; 6. `cb - s/2 n : 0`, the rim, as far as `E = cb - s/2 n + (e + w) d`.
//!
//! The scoop from E to its mirror image E' follows the cubic with the control points E, E + (0.35 W, -D),
//! E' - (0.35 W, D), E', where `W = la - 2 E.u` and `D = (q + E.o) / 0.75`, so that its middle lies at o = -q. It is
//! cut as #scoop_biarcs pairs of arcs between the cubic's points at equal parameter steps: with end points p, q, unit
//! tangents S, T, `v = q - p`, `x = v.(S + T)` and `l = v.v / (x + sqrt(x^2 + 2 (1 - S.T) v.v))` the pair meets in
//! `(p + l S + q - l T)/2`. An arc that leaves p along S for a chord c has the bulge `S x c / (|c| + S.c)`.
//!
//! The contour: long side v0-v1, hole at v1, short side v1-v2, hole at v2, then both sides again for v2-v3-v0. A
//! hole arc starts where the side before it ends and has the bulge `-tan((angle - asin(h/ri))/4)`, angle being the
//! corner's. Vertices that coincide with their successor (within 1e-9 mm) are left out.
//!
//! The concave corner between neck and shoulder is sharp unless `relief` is set: the published outline has it sharp
//! and no rounding of 0.3 mm stays within 0.01 mm of it. The cut rounds it by half the kerf. All other concave
//! corners are rounded by 0.3 mm at least, but for the slit's bottom, which is a half circle of radius s/2.
//!
//! Refuses sizes from which no simple contour follows; the sentence names the dimension and the remedy.
Expected<Path> element_outline(const HookParameters& parameters);

//! Pairs of arcs in one scoop: within 0.002 mm of the cubic for every element of the table (la 40 to 200 mm).
inline constexpr int scoop_biarcs = 12;

//! \brief A point of the scoop's cubic, in the frame of the short side, at t in [0, 1].
Vec2 scoop_point(const HookParameters& parameters, double t);

//! \brief The outline's points for programs that know no arcs: every arc is divided into equal pieces,
//! `max(ceil(segments/32), ceil(segments |sweep| / 2 pi - 1e-9))` of them. The closing point is not repeated.
//! \details The point at the fraction f of an arc from a with chord c and sweep phi is
//! `a + c sin(f phi/2)/sin(phi/2)`, the chord turned by `-(1 - f) phi/2`.
//! \param segments of a full circle, at least 8.
std::vector<Vec2> outline_points(const Path& outline, int segments);

//! \brief outline_points of element_outline.
Expected<std::vector<Vec2>> outline_points(const HookParameters& parameters, int segments);

} // namespace rhombloom
