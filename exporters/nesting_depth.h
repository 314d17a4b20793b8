#pragma once

#include <cstdint>
#include <vector>

#include "exporters/nesting_polygon.h"

namespace rhombloom::nesting {

//! \brief How deep a point lies in a polygon (mm, negative outside) and the way out of it.
struct Depth
{
    double depth = 0;
    Vec2 outward = Vec2::Zero(); //!< unit vector along which the depth falls fastest
};

//! \brief Depths in one polygon, looked up: the edges that can be nearest are known for every cell of a grid. Exact.
class DepthField
{
public:
    //! \param polygon  counter-clockwise
    //! \param rim      points further outside than this (mm) need not be told apart
    DepthField(const Polygon& polygon, double rim);

    //! \brief Is every point within \p radius of \p p further outside than the rim? May say no to be on the safe side.
    bool far_from(const Vec2& p, double radius) const;

    //! \brief The depth of \p p, at most down to the rim: further outside it is only known to be less.
    Depth at(const Vec2& p) const;

private:
    struct Edge
    {
        Vec2 from, along, normal;
        double length = 0;
        bool convex = true; //!< at its first point
    };
    struct Cell
    {
        std::uint32_t first = 0, last = 0; //!< candidates
        double depth = 0;                  //!< at its centre
    };

    Depth nearest(const Vec2& p, const std::uint32_t* first, const std::uint32_t* last) const;
    const Cell* cell_of(const Vec2& p) const;
    void fill(Cell& cell, const Vec2& centre);

    std::vector<Edge> edges_;
    std::vector<std::uint32_t> candidates_;
    std::vector<Cell> cells_;
    Vec2 corner_ = Vec2::Zero();
    double rim_ = 0;
    double size_ = 1; //!< of a cell
    int columns_ = 0;
    int rows_ = 0;
};

} // namespace rhombloom::nesting
