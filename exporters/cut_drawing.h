#pragma once

#include <string>
#include <vector>

#include "exporters/cut_sheet.h"
#include "exporters/nesting.h"

namespace rhombloom {

//! \brief One piece as it lies on a sheet: what each tool does to it, in the sheet's coordinates.
struct LaidPiece
{
    Path finished;              //!< the edge the piece shall have
    Path outer;                 //!< what the tool follows for it
    std::vector<Path> inner;    //!< slits cut by one line
    std::vector<Path> engraved; //!< single strokes
};

//! \brief The same contour, begun where its longest straight segment ends: the last segment is straight, and the mark
//! of the first burn is far from the slits.
Path begun_on_longest_line(const Path& contour);

//! \brief Where the diagonals of the piece cross, in the frame of element_outline(): half a turn about it changes
//! nothing.
Vec2 piece_centre(const HookParameters& parameters);

//! \brief Number and arrow for the middle of a piece, in the frame of element_outline(). The arrow runs along the long
//! sides and marks the front.
std::vector<Path> front_marks(const HookParameters& parameters, const std::string& label);

//! \brief The piece cut out at \p placement; kerf and marks as in \p options.
Expected<LaidPiece> laid_piece(const Path& outline, const std::vector<Path>& marks, const Placement& placement,
                               const CutOptions& options);

//! \brief The layers of a sheet, the paths of each in cutting order, named by \p ids, e.g. "element-17".
Drawing cut_drawing(const std::vector<LaidPiece>& pieces, const std::vector<std::string>& ids, const SheetSize& sheet,
                    const CutOptions& options);

} // namespace rhombloom
