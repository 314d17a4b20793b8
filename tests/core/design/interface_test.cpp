#include "core/design/interface.h"

#include <gtest/gtest.h>

#include "core/design/correspondence.h"
#include "core/model/layers.h"
#include "tests/core/design/shapes.h"

namespace rhombloom {
namespace {

const Element element;

std::vector<char> without_ring(const Surface& surface, Vertex v)
{
    std::vector<char> kept(surface.n_faces(), 1);
    for (const Face f : surface.vf_range(v)) {
        kept[f.idx()] = 0;
    }
    return kept;
}

Vertex five_valent(const Surface& surface)
{
    for (const Vertex v : surface.vertices()) {
        if (surface.valence(v) == 5) {
            return v;
        }
    }
    return Vertex();
}

TEST(Interface, TheRingOfA30BallsApexLeavesASawtoothOfTenVertices)
{
    const Surface ball = base_shape("ball-30", element)->surface;
    const auto made = cut(ball, element, without_ring(ball, five_valent(ball)));
    ASSERT_TRUE(made.has_value()) << made.error().message;
    ASSERT_EQ(made->loops.size(), 1u);
    const Interface& loop = made->loops[0];
    ASSERT_EQ(loop.size(), 10);
    int mountains = 0;
    for (int i = 0; i < 10; ++i) {
        EXPECT_NE(is_mountain(loop, i), is_valley(loop, i));
        mountains += is_mountain(loop, i) ? 1 : 0;
    }
    EXPECT_EQ(mountains, 5);
}

TEST(Interface, TheKeptElementsLieToTheLeft)
{
    const Surface ball = base_shape("ball-30", element)->surface;
    const std::vector<char> kept = without_ring(ball, five_valent(ball));
    const Interface loop = cut(ball, element, kept)->loops[0];
    for (int i = 0; i < loop.size(); ++i) {
        const Halfedge h = ball.find_halfedge(Vertex(loop.vertices[i]), Vertex(loop.vertices[(i + 1) % loop.size()]));
        EXPECT_TRUE(kept[ball.face_handle(h).idx()]);
    }
}

TEST(Interface, AnOpenedApexHasALoopOfTwiceItsValenceAndKeepsEveryElement)
{
    const Surface ball = base_shape("ball-30", element)->surface;
    for (const Vertex v : ball.vertices()) {
        const auto made = opened_apex(ball, element, v);
        ASSERT_TRUE(made.has_value());
        EXPECT_EQ(made->loops[0].size(), 2 * static_cast<int>(ball.valence(v)));
        EXPECT_TRUE(made->removed.empty());
        double angles = 0;
        for (const double angle : made->loops[0].angles) {
            angles += angle;
        }
        EXPECT_GT(angles, 0);
    }
}

TEST(Interface, NamesWhatIsDegenerate)
{
    const Surface ball = base_shape("ball-30", element)->surface;
    EXPECT_NE(cut(ball, element, std::vector<char>(30, 0)).error().message.find("nothing is left"), std::string::npos);
    EXPECT_NE(cut(ball, element, std::vector<char>(30, 1)).error().message.find("no element"), std::string::npos);
    std::vector<char> bow_tie(30, 1);
    const Vertex v = five_valent(ball);
    const auto ring = layers(ball, v)[0];
    bow_tie[ring[0].idx()] = 0;
    for (const Face f : ring) {
        const auto neighbours = ball.ff_range(ring[0]);
        if (f != ring[0] && std::find(neighbours.begin(), neighbours.end(), f) == neighbours.end()) {
            bow_tie[f.idx()] = 0;
            break;
        }
    }
    EXPECT_NE(cut(ball, element, bow_tie).error().message.find("touches itself"), std::string::npos);
    const Surface sheet = base_shape("sheet-4x4", element)->surface;
    std::vector<char> half(16, 1);
    std::fill(half.begin(), half.begin() + 8, 0);
    EXPECT_NE(cut(sheet, element, half).error().message.find("opening"), std::string::npos);
}

TEST(Interface, ZippingClosesTheValleyWithTheLargestDefectFirst)
{
    const Surface ball = base_shape("ball-30", element)->surface;
    const Interface loop = cut(ball, element, without_ring(ball, five_valent(ball)))->loops[0];
    const auto variants = shortened(loop, 8, permissible_defect(element), 4);
    ASSERT_FALSE(variants.empty());
    EXPECT_EQ(variants[0].size(), 8);
    double best = -1e300;
    for (int i = 0; i < loop.size(); ++i) {
        if (loop.elements[i] >= 2) {
            best = std::max(best, two_pi - loop.angles[i]);
        }
    }
    EXPECT_NEAR(variants[0].zipped_defect, best, 1e-12);
}

TEST(Correspondence, TwoOpenedBallsMatchMountainOnValleyOnly)
{
    const Surface ball = base_shape("ball-30", element)->surface;
    const Interface loop = opened_apex(ball, element, five_valent(ball))->loops[0];
    const auto matches = correspondences(loop, loop, permissible_defect(element));
    ASSERT_EQ(matches.size(), 5u); // valley on valley would pack six obtuse corners
    for (const Correspondence& match : matches) {
        EXPECT_NEAR(degrees(match.min_defect), 360 - 63.435 - 3 * 116.565, 1e-9);
    }
}

TEST(Correspondence, AlignmentFindsTheRigidMotionOfEqualLoops)
{
    Surface ball = shapes::embedded("ball-30").surface;
    const auto kept = without_ring(ball, five_valent(ball));
    const Interface fixed = cut(ball, element, kept)->loops[0];
    Interface moving = fixed;
    std::reverse(moving.points.begin(), moving.points.end());
    const Eigen::Isometry3d motion =
        Eigen::Translation3d(10, 20, 30) * Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized());
    for (Vec3& p : moving.points) {
        p = motion * p;
    }
    const Correspondence match{fixed.size() - 1, 0, 0};
    EXPECT_LT(misfit(fixed, moving, match, alignment(fixed, moving, match)), 1e-9);
}

} // namespace
} // namespace rhombloom
