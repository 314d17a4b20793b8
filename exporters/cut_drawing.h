#pragma once

#include <map>
#include <string>
#include <vector>

#include "exporters/cut_sheet.h"
#include "exporters/kerf.h"
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

//! \brief One contour and what the tool follows for it, which is found once for each way the contour lies.
class Blank
{
public:
    Blank(Path contour, const Kerf& kerf);

    //! \brief The contour at \p placement, which is never a mirrored one: the front of pieces is engraved.
    //! Refused when the kerf closes a gap of the contour.
    Expected<LaidPiece> laid(const Placement& placement);

private:
    Path contour_;
    Kerf kerf_;
    std::map<double, ToolPath> tool_paths_; //!< by angle; with equal kerfs the one of angle 0 serves all
};

//! \brief Paths in a piece's frame as they lie on the sheet.
std::vector<Path> laid(const std::vector<Path>& paths, const Placement& placement);

//! \brief "ENGRAVE #000000 engraves lines, ...": each layer of cut_drawing() with its colour and what it is for.
std::string layers_text(const CutOptions& options);

//! \brief The layers of a sheet, the paths of each in cutting order, named by \p ids, e.g. "element-17".
Drawing cut_drawing(const std::vector<LaidPiece>& pieces, const std::vector<std::string>& ids, const SheetSize& sheet,
                    const CutOptions& options);

} // namespace rhombloom
