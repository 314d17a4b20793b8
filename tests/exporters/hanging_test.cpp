#include "exporters/hanging.h"

#include <gtest/gtest.h>

#include "core/model/base_shapes.h"

namespace rhombloom {
namespace {

Surface shape(const char* name)
{
    return std::move(base_shape(name, Element{})->surface);
}

TEST(Hanging, AClosedShapeHangsFromOnePointAboveItsCentre)
{
    for (const char* name : {"ball-30", "polar-5x6", "rhombic-12", "dome-5x3"}) {
        const Surface surface = shape(name);
        const auto points = hanging_points(surface);
        ASSERT_EQ(points.size(), 1U) << name;
        const Vec3 centre = mass_centre(surface);
        EXPECT_LT((points[0] - centre).head<2>().norm(), 1e-9) << name;
        EXPECT_GT(points[0].z(), centre.z()) << name;
    }
}

// The centre lies within the triangle of the three cords: it does not tip.
TEST(Hanging, ARingAndATubeHangFromThreePointsRoundTheirCentre)
{
    for (const char* name : {"tube-6x6", "tube-8x10", "torus-12x6"}) {
        const Surface surface = shape(name);
        const auto points = hanging_points(surface);
        ASSERT_EQ(points.size(), 3U) << name;
        const Vec3 centre = mass_centre(surface);
        for (int k = 0; k < 3; ++k) {
            const Vec3 a = points[k] - centre, b = points[(k + 1) % 3] - centre;
            EXPECT_GT(a.x() * b.y() - a.y() * b.x(), 0) << name;
            EXPECT_GT(points[k].z(), centre.z()) << name;
        }
    }
}

TEST(Hanging, ASheetOfOneElementHasAPointToHangFrom)
{
    EXPECT_FALSE(hanging_points(shape("sheet-1x1")).empty());
    EXPECT_FALSE(hanging_points(shape("sheet-4x4")).empty());
}

} // namespace
} // namespace rhombloom
