#include "exporters/bending_modes_settle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/form/embedding.h"
#include "core/model/base_shapes.h"

namespace rhombloom {
namespace {

//! No two elements are alike: a ball whose vertices moved a few millimetres.
BentSurface uneven_ball(const Element& element)
{
    Surface surface = base_shape("ball-120", element)->surface;
    embed(surface, element);
    for (const Vertex v : surface.vertices()) {
        const double i = v.idx();
        surface.point(v) += 0.01 * element.la * Vec3(std::sin(7 * i), std::sin(11 * i + 1), std::sin(13 * i + 2));
    }
    return *bent_surface(surface, element);
}

TEST(Settle, KeepsOutlinesCornersAndLengths)
{
    const Element element;
    BentSurface bent = uneven_ball(element);
    SettleReport report;
    settle(bent, element, hook_parameters(element), 32, &report);
    EXPECT_LT(report.max_rim_distortion, 0.009);
    EXPECT_LT(report.max_corner_error_mm, 0.09);
    EXPECT_LT(report.p99_after, 1.25 * report.p99_before);
    EXPECT_LT(report.max_shift_mm, 0.1 * element.la);
    EXPECT_GT(report.max_shift_mm, 0.01); // there was something to settle
}

TEST(Settle, ModesDescribeTheSettledShapesExactly)
{
    const Element element;
    BentSurface bent = uneven_ball(element);
    const BendingModes modes = settle(bent, element, hook_parameters(element), 24);
    EXPECT_LE(modes.modes.cols(), 24);
    EXPECT_LT(error_mm(modes, bent), 1e-9);
}

//! What files hold in eight bits: both faces of the sheet move by whole numbers of the grain.
TEST(Settle, FineModesAreInWholeNumbers)
{
    const Element element;
    BentSurface bent = uneven_ball(element);
    const BendingModes modes = settle(bent, element, hook_parameters(element), 32);
    ASSERT_EQ(modes.grain.size(), modes.modes.cols());
    int fine = 0;
    for (int k = 0; k < modes.grain.size(); ++k) {
        if (modes.grain(k) > 0) {
            const Eigen::ArrayXd numbers = modes.modes.col(k).array() / modes.grain(k);
            EXPECT_LT((numbers - numbers.round()).abs().maxCoeff(), 1e-6);
            EXPECT_LE(numbers.abs().maxCoeff(), 127);
            ++fine;
        }
    }
    EXPECT_GT(fine, 0);
}

} // namespace
} // namespace rhombloom
