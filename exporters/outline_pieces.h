#pragma once

#include <string>
#include <vector>

#include "core/expected.h"
#include "exporters/drawing.h"

//! Inside of the outline reader: one function per format, which hands back what is drawn, piece by piece.
namespace rhombloom::reading {

inline constexpr double join_tolerance = 0.05;   //!< mm between ends that belong together
inline constexpr double curve_tolerance = 0.002; //!< mm between other curves and their chords
inline constexpr std::size_t most_points = 200000;

//! What a file draws.
struct Pieces
{
    std::vector<Path> paths; //!< closed ones and loose ones, mm, y up
    bool curves = false;     //!< some were flattened
};

Expected<Pieces> svg_pieces(const std::string& bytes);
Expected<Pieces> dxf_pieces(const std::string& bytes);
Expected<Pieces> json_pieces(const std::string& bytes);

//! \brief The one closed contour that \p paths make when ends that meet are joined.
Expected<Path> joined(std::vector<Path> paths);

//! \brief Add an arc of \p sweep radians (positive counter-clockwise) from the path's last vertex to \p end, in halves
//! when it is more than half a circle.
void add_arc(Path& path, const Vec2& end, double sweep);

} // namespace rhombloom::reading
