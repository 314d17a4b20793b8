#pragma once

#include <optional>
#include <vector>

#include "core/expected.h"
#include "exporters/drawing.h"

namespace rhombloom {

//! How a copy may lie with respect to the sheet's grain (or the film's, or the print's direction).
enum class Grain
{
    Any,      //!< any angle
    HalfTurn, //!< as drawn or turned by 180 degrees
    Fixed     //!< as drawn
};

//! May a copy be cut as its mirror image (then turned over)?
enum class Mirror
{
    Never,
    Allowed
};

//! How long to look for one copy more on a sheet.
enum class Effort
{
    Quick,      //!< patterns and rows alone
    SaveSheets, //!< only where one copy more per sheet would save a sheet
    FillSheets  //!< wherever more than one sheet is needed
};

//! \brief What to nest into. Lengths in mm.
struct NestOptions
{
    double sheet_width = 600;
    double sheet_height = 400;
    double margin = 0;  //!< between a finished edge and the edge of the sheet
    double spacing = 2; //!< between finished edges of neighbours
    int count = 1;
    Grain grain = Grain::Any;
    Mirror mirror = Mirror::Never;
    Effort effort = Effort::FillSheets;
    std::optional<Vec2> remnant; //!< width and height of an offcut that is filled first
};

//! \brief One copy: the outline mirrored in the y axis (x becomes -x) if \p mirrored, turned by \p angle about its
//! origin (radians), then moved by \p offset from the sheet's lower left corner.
struct Placement
{
    double angle = 0;
    bool mirrored = false;
    Vec2 offset = Vec2::Zero();
};

struct Sheet
{
    double width = 0;
    double height = 0;
    bool remnant = false; //!< this is the offcut given in the options
    std::vector<Placement> placements;
    Box used;   //!< bounds of the copies
    Box offcut; //!< largest rectangle along a side of the sheet, a spacing away from the copies; empty if none
};

struct Nesting
{
    std::vector<Sheet> sheets;
    int per_sheet = 0; //!< copies that a whole sheet takes
    double utilisation =
        0; //!< area of the copies / area of the sheets used; of the last one only the part not left over
};

//! \brief Lay \p count copies of one simple outline (any number of points, either sense) on as few sheets as found.
//! \details Searches lattices of one and two copies per cell, rows parallel to a side, and free places along the
//! edges, on the sheet at hand (cf. Stoyan and Pankratov, EJOR 113, 1999); then looks for one copy more by moving and
//! turning all of them at once. Gaps hold to 1e-6 mm. The work is bounded by iterations, never by the clock: the same
//! input gives the same layout.
//! Refuses outlines that cross themselves, impossible options, and copies larger than the sheet.
Expected<Nesting> nest(const std::vector<Vec2>& outline, const NestOptions& options);

//! \brief A counter-clockwise polygon that contains the closed \p path and keeps within \p slack (mm) of it: what to
//! nest when arcs shall keep their distance too.
std::vector<Vec2> enclosing_polygon(const Path& path, double slack);

//! \brief Point \p p of the outline where \p placement puts it.
Vec2 placed(const Vec2& p, const Placement& placement);

} // namespace rhombloom
