#pragma once

#include "core/model/element.h"
#include "exporters/drawing.h"

namespace rhombloom {

//! \brief All dimensions of the flat piece (mm, radians): the element's and those of its four hooks.
struct HookParameters
{
    double la = 80, lb = 88, alpha = radians(63.435), thickness = 0.5;
    double slit = 0;             //!< throat s
    double finger_width = 0;     //!< w, the master size
    double hole_radius = 0;      //!< ri, round each node
    double pivot_radius = 0;     //!< Rp = ri + w
    double finger_length = 0;    //!< e, straight part
    double finger_turn = 0;      //!< eta
    double lip = 0;              //!< m, of the long side
    double neck_setback = 0;     //!< cn
    double seat_clearance = 0;   //!< cs
    double barb = 0;             //!< b
    double lip_rounding = 0;     //!< rs
    double scoop_depth = 0;      //!< q
};

//! \brief The default proportions for an element.
HookParameters hook_parameters(const Element& element);

//! \brief The contour of the flat piece, counter-clockwise, lines and arcs; corner v0 (acute) in the origin and the
//! long side v0-v1 on the x axis. Acute corners at v0 and v2, hooks on the short sides v1-v2 and v3-v0.
Expected<Path> element_outline(const HookParameters& parameters);

} // namespace rhombloom
