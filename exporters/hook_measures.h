#pragma once

#include <vector>

#include "exporters/outline.h"

namespace rhombloom {

//! \brief Width of the narrowest part that holds a finger, mm: twice the largest erosion that leaves one piece with
//! all four finger tips. Measured on the outline, to 0.01 mm.
double narrowest_web(const HookParameters& parameters, const Path& outline);

//! \brief The piece as seen from above when its long sides are bowed: its long direction is shortened between the
//! rigid ends so that the nodes of a long side are la apart. The long side lies on the x axis from the origin.
std::vector<Vec2> bowed_plan(const HookParameters& parameters, const Path& outline);

//! \brief The arc that a long side bows into between the two slit bottoms (Euler's column taken as a circle).
struct Bow
{
    double slope = 0;   //!< phi, at its ends, radians
    double radius = 0;  //!< mm
    double sagitta = 0; //!< mm
};

//! \brief The arc of length \p arc on a chord of \p chord, mm. \pre 0 < chord < arc
Bow bow(double arc, double chord);

//! \brief What holds two pieces together along one edge, seen from above, the short side of A on the x axis.
struct Interlock
{
    int fingers = 0;      //!< overlaps in which A lies over B
    int lips = 0;         //!< overlaps in which B lies over A
    bool crossed = false; //!< an overlap at rest would have to be both
    std::vector<double>
        travel; //!< mm that B can move before it is blocked, for directions 0, 15 .. 345 degrees; up to 1
};

//! \brief The interlock certificate (cf. hook checks, C12).
//! \details At rest B's long side lies on A's short side with its shoulders at A's slit bottoms. Each end then overlaps
//! twice: A's finger lies over B, and B's lip over A's rim; B passes down through the slit in between. B is blocked
//! as soon as a finger overlap and a lip overlap are one: a sheet cannot be above and below another at once.
Interlock interlock(const HookParameters& parameters, const Path& outline);

//! \brief Largest distance, mm, between the hook and shoulder at an acute corner and those of a turned-over piece at
//! its obtuse corner: 0 when front and back pieces fit the same node.
double flip_mismatch(const HookParameters& parameters, const Path& outline);

} // namespace rhombloom
