#include "exporters/bent_element.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/form/embedding.h"
#include "core/model/base_shapes.h"
#include "exporters/bending_modes.h"
#include "exporters/bent_element_solid.h"

namespace rhombloom {
namespace {

Surface embedded(const std::string& name, const Element& element)
{
    Surface surface = base_shape(name, element)->surface;
    embed(surface, element);
    return surface;
}

BentSurface bent(const std::string& name, const Element& element = {})
{
    return *bent_surface(embedded(name, element), element);
}

double rim(const BentSurface& surface, const std::vector<Vec3>& points)
{
    double sum = 0;
    for (std::size_t i = 0; i < surface.sheet.rim; ++i) {
        sum += (points[(i + 1) % surface.sheet.rim] - points[i]).norm();
    }
    return sum;
}

double sheet_area(const FlatSheet& sheet)
{
    double sum = 0;
    for (const auto& t : sheet.triangles) {
        const Vec2 u = sheet.points[t[1]] - sheet.points[t[0]];
        const Vec2 v = sheet.points[t[2]] - sheet.points[t[0]];
        sum += 0.5 * (u.x() * v.y() - u.y() * v.x());
    }
    return sum;
}

TEST(FlatSheet, TrianglesCoverTheOutlineOnce)
{
    for (const double alpha : {52.0, 63.435, 78.0}) {
        const Element element{100, 112, radians(alpha), 0.5};
        const Path outline = *element_outline(hook_parameters(element));
        const FlatSheet sheet = flat_sheet(outline);
        EXPECT_NEAR(sheet_area(sheet) / area(outline), 1, 0.002) << alpha;
        // Euler: a disc.
        EXPECT_EQ(sheet.triangles.size(), 2 * sheet.points.size() - sheet.rim - 2);
    }
}

TEST(FlatSheet, NoTriangleIsTurnedOver)
{
    const FlatSheet sheet = flat_sheet(*element_outline(hook_parameters({})));
    for (const auto& t : sheet.triangles) {
        const Vec2 u = sheet.points[t[1]] - sheet.points[t[0]];
        const Vec2 v = sheet.points[t[2]] - sheet.points[t[0]];
        EXPECT_GE(u.x() * v.y() - u.y() * v.x(), -1e-9);
    }
}

TEST(BentElement, CornersLieOnTheirVertices)
{
    const Element element;
    const Surface surface = embedded("polar-5x4", element);
    const BentSurface b = *bent_surface(surface, element);
    const std::array<Vec2, 4> flat = flat_corners(element);
    for (const BentElement& e : b.elements) {
        for (int k = 0; k < 4; ++k) {
            EXPECT_LT((bent_position(e.patch, flat[k]) - surface.point(Vertex(e.corners[k]))).norm(), 1e-6);
        }
    }
}

TEST(BentElement, OutlinesKeepTheirLengthWithinOnePercent)
{
    for (const char* name : {"ball-30", "polar-5x4", "ball-120"}) {
        const BentSurface b = bent(name);
        for (const BentElement& e : b.elements) {
            EXPECT_NEAR(rim(b, e.points) / rim_length(b.sheet), 1, 0.01) << name;
        }
        EXPECT_LT(b.report.max_rim_distortion, 0.01) << name;
    }
}

TEST(BentElement, LongSidesAreArcsOfTheRightLengthBowedOutward)
{
    const Element element;
    const Surface surface = embedded("ball-30", element);
    const BentSurface b = *bent_surface(surface, element);
    for (const BentElement& e : b.elements) {
        double length = 0;
        for (int i = 0; i < 200; ++i) {
            length += (bent_position(e.patch, Vec2((i + 1) * element.lb / 200, 0)) -
                       bent_position(e.patch, Vec2(i * element.lb / 200, 0)))
                          .norm();
        }
        EXPECT_NEAR(length / element.lb, 1, 0.02);
        const Vec3 a = surface.point(Vertex(e.corners[0]));
        const Vec3 c = surface.point(Vertex(e.corners[1]));
        const Vec3 middle = bent_position(e.patch, Vec2(element.lb / 2, 0));
        EXPECT_GT((middle - 0.5 * (a + c)).dot(middle.normalized()), 0.1 * element.la); // the ball is centred
    }
}

//! The hooks' points of \p e beyond its short sides, on the finger.
std::vector<std::size_t> finger_points(const FlatSheet& sheet, const Element& element, const HookParameters& hooks)
{
    std::vector<std::size_t> found;
    const std::array<Vec2, 4> c = flat_corners(element);
    for (std::size_t i = 0; i < sheet.rim; ++i) {
        for (const int side : {1, 3}) {
            const Vec2 d = (c[(side + 1) % 4] - c[side]).normalized();
            const Vec2 r = sheet.points[i] - c[side];
            const double along = std::min(r.dot(d), element.la - r.dot(d));
            if (r.x() * d.y() - r.y() * d.x() > hooks.slit && along > pivot_radius(hooks) + hooks.slit) {
                found.push_back(i);
            }
        }
    }
    return found;
}

//! Signed distance of \p p to the nearest point of the other sheets along their outward normal; the nearest sheet only.
double height_over_others(const BentSurface& b, std::size_t self, const Vec3& p)
{
    double best = 1e300;
    double height = 0;
    for (std::size_t f = 0; f < b.elements.size(); ++f) {
        for (int i = 0; f != self && i <= 40; ++i) {
            for (int j = 0; j <= 40; ++j) {
                const Vec2 q = b.elements[f].patch.to_unit.inverse() * Vec2(i / 40.0, j / 40.0);
                const Vec3 d = p - bent_position(b.elements[f].patch, q);
                if (d.norm() < best) {
                    best = d.norm();
                    height = d.dot(bent_normal(b.elements[f].patch, q, b.elements[f].outward));
                }
            }
        }
    }
    return height;
}

TEST(BentElement, FingersLieOutsideTheNeighbour)
{
    const Element element;
    for (const char* name : {"ball-30", "polar-5x4"}) {
        const BentSurface b = bent(name);
        const auto fingers = finger_points(b.sheet, element, hook_parameters(element));
        ASSERT_GT(fingers.size(), 12U);
        for (std::size_t k = 0; k < fingers.size(); k += 3) {
            const std::size_t f = (7 * k) % b.elements.size();
            EXPECT_GT(height_over_others(b, f, b.elements[f].points[fingers[k]]), 0.9 * element.thickness) << name;
        }
    }
}

TEST(BentElement, BodyIsNearlyIsometric)
{
    // Measured 0.041 and 0.050; the hooks climb over the neighbours within a few millimetres.
    EXPECT_LT(bent("ball-30").report.max_length_distortion, 0.06);
    EXPECT_LT(bent("ball-270").report.max_length_distortion, 0.06);
}

TEST(BentElement, SizeDoesNotMatter)
{
    const Element small{100, 110, radians(63.435), 0.5};
    const Element large{200, 220, radians(63.435), 1};
    const BendingReport a = bent("ball-30", small).report;
    const BendingReport b = bent("ball-30", large).report;
    EXPECT_NEAR(a.mean_bow_mm / 100, b.mean_bow_mm / 200, 0.01);
    EXPECT_LT(b.max_rim_distortion, 0.01);
}

TEST(BentElement, SteepAndLongElementsBendToo)
{
    for (const Element element : {Element{80, 116, radians(63.435), 0.5}, Element{80, 84, radians(52), 0.8},
                                  Element{120, 130, radians(76), 0.2}}) {
        const BentSurface b = bent("ball-30", element);
        EXPECT_LT(b.report.max_corner_error_mm, 0.1);
        for (const BentElement& e : b.elements) {
            for (const Vec3& p : e.points) {
                ASSERT_TRUE(p.allFinite());
                ASSERT_LT(p.norm(), 3 * element.la);
            }
        }
    }
}

// Where the hooks reach over strongly bent neighbours, outlines came out up to 3 % too long.
TEST(BentElement, OutlinesOfOddElementsKeepTheirLengthToo)
{
    const std::vector<std::pair<std::string, Element>> odd = {{"torus-12x6", {100, 112, radians(50), 0.5}},
                                                              {"torus-12x6", {200, 270, radians(63.435), 0.8}},
                                                              {"tube-6x6", {200, 300, radians(63.435), 0.8}},
                                                              {"polar-5x4", {40, 60, radians(50), 0.3}},
                                                              {"sheet-4x6", {60, 66, radians(80), 0.2}}};
    for (const auto& [name, element] : odd) {
        EXPECT_LT(bent(name, element).report.max_rim_distortion, 0.01) << name << ", la " << element.la;
    }
}

TEST(SolidElement, IsClosedAndLooksOutward)
{
    const BentSurface b = bent("polar-5x4");
    for (const BentElement& e : b.elements) {
        const SolidElement solid = solid_element(b, e, 0.5);
        double volume = 0;
        for (const auto& t : solid_triangles(b.sheet, e.outward)) {
            volume += solid.points[t[0]].dot(solid.points[t[1]].cross(solid.points[t[2]])) / 6;
        }
        EXPECT_NEAR(volume / (0.5 * sheet_area(b.sheet)), 1, 0.04);
    }
}

TEST(BendingModes, ReachTheToleranceAsked)
{
    const BentSurface b = bent("ball-270");
    for (const double tolerance : {1.0, 0.1, 0.01}) {
        const BendingModes modes = bending_modes(b, tolerance, 40);
        EXPECT_LT(modes.modes.cols(), 40);
        EXPECT_LE(error_mm(modes, b), tolerance);
    }
}

TEST(BendingModes, OneShapeNeedsNoModes)
{
    EXPECT_EQ(bending_modes(bent("ball-30"), 0.05, 40).modes.cols(), 0);
}

} // namespace
} // namespace rhombloom
