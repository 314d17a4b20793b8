#pragma once

#include <cstdint>
#include <vector>

#include "exporters/thumbnail.h"

namespace rhombloom {

//! \brief Triangles to draw, two-sided; one normal per point and one element number per triangle.
struct RasterScene
{
    std::vector<Vec3> points;  //!< mm
    std::vector<Vec3> normals; //!< unit, outward
    std::vector<std::array<int, 3>> triangles;
    std::vector<std::int32_t> elements;
};

//! \brief What is seen in each sample: depth from the viewer, normal, element, and how many sheets lie together.
struct Samples
{
    int width = 0;
    int height = 0;
    std::vector<float> depth;            //!< mm before the eye, positive; infinity where there is nothing
    std::vector<Eigen::Vector3f> normal; //!< outward
    std::vector<std::int32_t> element;   //!< -1: none
    std::vector<std::uint8_t> sheets;    //!< within a few mm of the first

    std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

//! \brief A projection to samples: perspective, or parallel when tangent is 0.
struct Projection
{
    PictureCamera camera;
    double extent = 1; //!< parallel only: half the height, mm
    int width = 0;
    int height = 0;

    //! Sample coordinates and depth of a point.
    Vec3 operator()(const Vec3& p) const;

    //! The point at a sample's middle and depth.
    Vec3 unproject(double x, double y, double depth) const;
};

Samples rasterise(const RasterScene& scene, const Projection& projection, double sheet_range_mm);

} // namespace rhombloom
