#include "core/model/regions.h"

#include <gtest/gtest.h>

#include "core/model/base_shapes.h"

namespace rhombloom {
namespace {

Surface shape(const std::string& name)
{
    return base_shape(name, Element{}).value().surface;
}

TEST(ConnectedRegions, AreOneOnAConnectedSurface)
{
    const Surface surface = shape("ball-30");
    const auto regions = connected_regions(surface);
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_EQ(regions[0].size(), surface.n_faces());
    EXPECT_EQ(regions[0].front(), Face(0));
}

TEST(ConnectedRegions, EndAtWhatIsLeftOut)
{
    const Surface strip = shape("sheet-1x5");
    std::vector<char> left_out(strip.n_faces(), 0);
    left_out[2] = 1;
    const std::vector<std::vector<Face>> two = {{Face(0), Face(1)}, {Face(3), Face(4)}};
    EXPECT_EQ(connected_regions(strip, left_out), two);
}

} // namespace
} // namespace rhombloom
