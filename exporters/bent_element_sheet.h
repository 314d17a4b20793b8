#pragma once

#include <array>
#include <vector>

#include "exporters/outline.h"

namespace rhombloom {

//! \brief The flat piece as triangles: what bent_element() bends.
struct FlatSheet
{
    std::vector<Vec2> points; //!< mm, in the frame of element_outline(); the outline's points come first
    std::size_t rim = 0;      //!< number of outline points, a counter-clockwise loop
    std::vector<std::array<int, 3>> triangles; //!< counter-clockwise
};

struct FlatSheetOptions
{
    double tolerance = 0.35; //!< mm, of the rim to the true outline
    double rim_step = 12;    //!< mm, longest segment of the rim
    double along = 12;       //!< mm, spacing of the inner points along the long sides, the direction that bends
    double across = 22;      //!< mm, and across them
};

//! \brief The same share of any element: as above for one whose short side is 80 mm long.
FlatSheetOptions sheet_options(const Element& element);

//! \brief Triangulate \p outline with inner points so fine that bending shows no corners.
//! \pre the outline is simple and counter-clockwise (element_outline() guarantees it).
FlatSheet flat_sheet(const Path& outline, const FlatSheetOptions& options = {});

//! \brief The rim of \p sheet as a closed path length, mm.
double rim_length(const FlatSheet& sheet);

} // namespace rhombloom
