#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace rhombloom {

using Vec2 = Eigen::Vector2d;

//! \brief a x b, positive when b lies counter-clockwise of a.
inline double cross_2d(const Vec2& a, const Vec2& b)
{
    return a.x() * b.y() - a.y() * b.x();
}

//! \brief A vertex and the segment that follows it: straight when bulge is 0, else an arc with bulge =
//! tan(included angle / 4), positive counter-clockwise (as in DXF). Arcs are at most half circles.
struct PathVertex
{
    Vec2 point = Vec2::Zero(); //!< mm, y up
    double bulge = 0;
};

//! \brief A chain of lines and arcs. A closed path's last segment leads back to its first vertex.
struct Path
{
    std::vector<PathVertex> vertices;
    bool closed = true;
    std::string id = {}; //!< names the path in files that have names (SVG), e.g. "element-17"
};

struct Box
{
    Vec2 min = Vec2::Constant(1e300);
    Vec2 max = Vec2::Constant(-1e300);
};

//! What a machine does with a layer.
enum class LayerUse
{
    Engrave,
    CutInner,
    CutOuter,
    Sheet,
    Reference
};

struct Layer
{
    std::string name; //!< e.g. "CUT_OUTER"
    LayerUse use = LayerUse::CutOuter;
    unsigned rgb = 0; //!< 0xRRGGBB
    std::vector<Path> paths;
};

//! \brief One sheet: layers of paths, in mm, origin in the lower left corner. What SVG, DXF and PDF are written from.
struct Drawing
{
    double width = 0;
    double height = 0;
    std::vector<Layer> layers;
    std::vector<std::string> notes; //!< settings recorded in the file, one "key: value" each
};

//! \brief Exact signed area of a closed path (arcs included), mm2, positive counter-clockwise.
double area(const Path& path);

//! \brief Exact length, mm.
double length(const Path& path);

//! \brief Exact bounds, arcs included.
Box bounds(const Path& path);

//! \brief The path rotated by \p angle about the origin, then moved by \p offset.
Path placed(const Path& path, double angle, const Vec2& offset);

//! \brief The path mirrored in the y axis; a counter-clockwise path is clockwise afterwards.
Path mirrored(const Path& path);

//! \brief Points along the path whose chords stay within \p tolerance (mm) of it; the closing point is not repeated.
std::vector<Vec2> flatten(const Path& path, double tolerance);

} // namespace rhombloom
