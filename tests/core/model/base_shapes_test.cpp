#include "core/model/base_shapes.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/model/angular_defect.h"
#include "core/model/layers.h"
#include "core/model/validity.h"

namespace rhombloom {
namespace {

BaseShape shape(const std::string& name)
{
    auto made = base_shape(name, Element{});
    EXPECT_TRUE(made.has_value()) << made.error().message;
    return std::move(*made);
}

//! Defects in tenths of a degree and how many vertices have each.
std::map<int, int> defect_histogram(const Surface& surface)
{
    std::map<int, int> histogram;
    for (const Vertex v : surface.vertices()) {
        if (!surface.is_boundary(v)) {
            ++histogram[static_cast<int>(std::lround(10 * degrees(angular_defect(surface, Element{}, v))))];
        }
    }
    return histogram;
}

int flips(const Surface& surface)
{
    int count = 0;
    for (const Face f : surface.faces()) {
        count += surface.data(f).facing == Facing::Back ? 1 : 0;
    }
    return count;
}

class LibraryShape : public testing::TestWithParam<std::string>
{
};

TEST_P(LibraryShape, IsValidWithTheElementCountOfItsName)
{
    const BaseShape made = shape(GetParam());
    EXPECT_TRUE(validate(made.surface, Element{}).ok());
    const std::string numbers = GetParam().substr(GetParam().find('-') + 1);
    const std::size_t cross = numbers.find('x');
    const int expected = cross == std::string::npos
                             ? std::stoi(numbers)
                             : std::stoi(numbers.substr(0, cross)) * std::stoi(numbers.substr(cross + 1));
    EXPECT_EQ(static_cast<int>(made.surface.n_faces()), expected);
}

// Gauss-Bonnet with the boundary's turning: sum of defects = 2 pi chi - boundary turning.
TEST_P(LibraryShape, ObeysGaussBonnet)
{
    const Surface surface = shape(GetParam()).surface;
    double total = 0;
    for (const Vertex v : surface.vertices()) {
        double angles = 0;
        for (const Face f : surface.vf_range(v)) {
            angles += corner_angle(surface, Element{}, f, v);
        }
        total += (surface.is_boundary(v) ? pi : two_pi) - angles;
    }
    EXPECT_NEAR(total, two_pi * validate(surface, Element{}).euler_characteristic, 1e-9);
}

TEST_P(LibraryShape, LayersHoldEveryElementOnce)
{
    const BaseShape made = shape(GetParam());
    std::vector<int> seen(made.surface.n_faces(), 0);
    for (const auto& layer : layers(made.surface, made.seed)) {
        for (const Face f : layer) {
            ++seen[f.idx()];
        }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<long>(seen.size()));
}

TEST_P(LibraryShape, PointsOutwardsWhereItIsClosed)
{
    const Surface surface = shape(GetParam()).surface;
    double volume = 0;
    for (const Face f : surface.faces()) {
        const Quad q = quad(surface, f);
        const Vec3 a = surface.point(Vertex(q[0]));
        const Vec3 b = surface.point(Vertex(q[1]));
        const Vec3 c = surface.point(Vertex(q[2]));
        const Vec3 d = surface.point(Vertex(q[3]));
        volume += a.dot(b.cross(c)) + a.dot(c.cross(d));
    }
    const bool closed = validate(surface, Element{}).boundary_loops == 0;
    EXPECT_TRUE(!closed || volume > 0);
}

INSTANTIATE_TEST_SUITE_P(Library, LibraryShape, testing::ValuesIn(base_shape_names()), [](const auto& param_info) {
    std::string name = param_info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(BaseShapes, TheBallOf30HasTwelveFiveAndTwentyThreeValentVertices)
{
    const std::map<int, int> expected = {{103, 20}, {428, 12}};
    EXPECT_EQ(defect_histogram(shape("ball-30").surface), expected);
}

TEST(BaseShapes, JoinsAreAllFrontAndHaveOnlyThreeKindsOfVertices)
{
    for (const char* name : {"ball-90", "ball-120", "ball-210", "ball-270"}) {
        const Surface surface = shape(name).surface;
        EXPECT_EQ(flips(surface), 0) << name;
        const auto histogram = defect_histogram(surface);
        EXPECT_EQ(histogram.at(428), 12) << name;
        EXPECT_EQ(histogram.at(103), static_cast<int>(surface.n_faces()) * 2 / 3) << name;
    }
}

TEST(BaseShapes, CheckerboardsKeepTheirSolidsDefectsAndAreFlatElsewhere)
{
    const auto histogram = defect_histogram(shape("checker-270").surface);
    const std::map<int, int> expected = {{0, 240}, {103, 20}, {428, 12}};
    EXPECT_EQ(histogram, expected);
    EXPECT_EQ(flips(shape("checker-120").surface), 60);
    EXPECT_EQ(flips(shape("checker-270").surface), 120);
}

TEST(BaseShapes, RhombicSolidsHaveTheKnownFlips)
{
    EXPECT_EQ(flips(shape("rhombic-6").surface), 3);
    EXPECT_EQ(flips(shape("rhombic-12").surface), 0);
    EXPECT_EQ(flips(shape("rhombic-20").surface), 10);
    EXPECT_EQ(flips(shape("rhombic-30").surface), 0);
}

TEST(BaseShapes, UnknownNamesAreRefusedWithTheFamilies)
{
    for (const char* name : {"", "ball", "ball-", "ball-30x", "balls-30", "ball-31", "polar-2x4", "polar-5", "polar-5x",
                             "torus-12x5", "ball-99999999999999999999", "sheet-1000x1000", "BALL-30", "ball--30"}) {
        EXPECT_FALSE(base_shape(name, Element{}).has_value()) << name;
    }
}

} // namespace
} // namespace rhombloom
