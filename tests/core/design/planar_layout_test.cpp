#include "core/design/planar_layout.h"

#include <gtest/gtest.h>

#include "core/model/angular_defect.h"
#include "core/model/base_shapes.h"
#include "core/model/validity.h"

namespace rhombloom {
namespace {

const Element element;

//! The net of a closed surface: every element dropped somewhere in the plane, every edge a join.
Layout net(const Surface& surface)
{
    Layout layout{"net", {}, {}, Vec3::Zero()};
    const auto first_long = [&](Face f) {
        return side(surface, side_halfedge(surface, f, 0)) == Side::Long ? 0 : 1; // number of our side 0
    };
    for (const Face f : surface.faces()) {
        layout.elements.push_back({{100.0 * (f.idx() % 6), 100.0 * (f.idx() / 6)}, 0, surface.data(f).facing});
    }
    for (const Edge e : surface.edges()) {
        const Halfedge h = surface.halfedge_handle(e, 0);
        const Halfedge o = surface.opposite_halfedge_handle(h);
        if (surface.is_boundary(h) || surface.is_boundary(o)) {
            continue;
        }
        const Face f = surface.face_handle(h);
        const Face g = surface.face_handle(o);
        layout.joins.push_back({f.idx(), (side_index(surface, h) - first_long(f) + 4) % 4, g.idx(),
                                (side_index(surface, o) - first_long(g) + 4) % 4});
    }
    return layout;
}

TEST(PlanarLayout, AnElementKeepsItsAngles)
{
    const auto one = planar_layout({"one", {{}}, {}, Vec3::Zero()}, element);
    ASSERT_TRUE(one.has_value());
    EXPECT_NEAR((one->point(Vertex(1)) - one->point(Vertex(0))).norm(), element.lb, 1e-9);
    EXPECT_NEAR((one->point(Vertex(2)) - one->point(Vertex(0))).norm(), long_diagonal(element), 1e-9);
}

TEST(PlanarLayout, TheNetOfA30BallFindsItsShapeFromFlat)
{
    Surface ball = base_shape("ball-30", element)->surface;
    const double energy = embed(ball, element).energy;
    auto flat = planar_layout(net(ball), element);
    ASSERT_TRUE(flat.has_value()) << flat.error().message;
    EXPECT_TRUE(validate(*flat, element).ok());
    const EmbedReport report = unfold(*flat, element);
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(report.energy, energy, 1e-6);
}

TEST(PlanarLayout, FiveFrontElementsRoundAVertexRiseOutOfThePlane)
{
    const Surface dome = base_shape("dome-5x3", element)->surface;
    Layout layout = net(dome);
    auto flat = planar_layout(layout, element);
    ASSERT_TRUE(flat.has_value()) << flat.error().message;
    EXPECT_TRUE(unfold(*flat, element).converged);
    double low = 1e300;
    double high = -1e300;
    for (const Vertex v : flat->vertices()) {
        low = std::min(low, flat->point(v).z());
        high = std::max(high, flat->point(v).z());
    }
    EXPECT_GT(high - low, 0.5 * element.la);
}

TEST(PlanarLayout, RefusesByNumber)
{
    const std::vector<LayoutElement> two(2);
    const auto reason = [&](std::vector<LayoutJoin> joins) {
        const auto made = planar_layout({"x", two, joins, Vec3::Zero()}, element);
        return made ? std::string("accepted") : made.error().message;
    };
    EXPECT_EQ(reason({{0, 0, 1, 1}}), "accepted");
    EXPECT_NE(reason({{0, 0, 1, 2}}).find("both long"), std::string::npos);
    EXPECT_NE(reason({{0, 0, 1, 1}, {0, 0, 1, 3}}).find("joined twice"), std::string::npos);
    EXPECT_NE(reason({{0, 0, 7, 1}}).find("element 7"), std::string::npos);
    EXPECT_NE(reason({}).find("2 unconnected parts"), std::string::npos);
}

} // namespace
} // namespace rhombloom
