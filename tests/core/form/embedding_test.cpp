#include "core/form/embedding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Geometry>

#include "core/form/spring_energy.h"
#include "core/model/base_shapes.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom {
namespace {

double largest_distance(const Surface& a, const Surface& b)
{
    double largest = 0;
    for (const Vertex v : a.vertices()) {
        largest = std::max(largest, (a.point(v) - b.point(v)).norm());
    }
    return largest;
}

void transform(Surface& surface, const std::function<Vec3(const Vec3&)>& map)
{
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, map(surface.point(v)));
    }
}

Surface settled_ball(int level)
{
    Surface surface = shapes::ball_surface(level);
    EXPECT_TRUE(embed(surface, {}).converged);
    return surface;
}

TEST(Embedding, FindsTheThirtyBallOfTheDesign)
{
    Surface surface = shapes::ball_surface(0);
    const EmbedReport report = embed(surface, {});
    EXPECT_TRUE(report.converged) << report.message;
    EXPECT_NEAR(report.spring_energy, 58.4927, 5e-5);
    EXPECT_EQ(report.concavity_energy, 0);
    EXPECT_EQ(report.guard_energy, 0);
    EXPECT_NEAR(report.max_stretch, 0.00153, 5e-6);
    EXPECT_LE(report.gradient_norm, 1e-9);
}

// The symmetric 30-ball has two unknowns: the distances of the 12 five-valent and the 20 three-valent vertices from the
// centre. Its energy is written down here once more, from the geometry of the icosahedron.
double symmetric_energy(double five, double three, const Element& element)
{
    const double golden = (1 + std::sqrt(5.0)) / 2;
    const double edge_angle = std::acos(1 / std::sqrt(5.0)); // between neighbouring five-valent ones
    const double dual_angle = std::acos(std::sqrt(5.0) / 3); // between neighbouring three-valent ones
    const double mixed_angle = std::acos(golden * golden / std::sqrt(3.0 * (golden + 2))); // between the two kinds
    const double edge = std::sqrt(five * five + three * three - 2 * five * three * std::cos(mixed_angle));
    const double long_chord = 2 * five * std::sin(edge_angle / 2);
    const double short_chord = 2 * three * std::sin(dual_angle / 2);
    const auto spring = [](double length, double rest) {
        return (length > rest ? 100 : 1) / rest * (length - rest) * (length - rest);
    };
    return 60 * (spring(edge, element.la) + spring(edge, element.lb)) +
           30 * (spring(long_chord, long_diagonal(element)) + spring(short_chord, short_diagonal(element)));
}

// Coordinate-wise golden section is enough for two unknowns.
double smallest_symmetric_energy(const Element& element)
{
    double r[2] = {1.6 * element.la, 1.45 * element.la};
    double energy = symmetric_energy(r[0], r[1], element);
    for (double step = 0.1 * element.la; step > 1e-10 * element.la;) {
        bool better = false;
        for (const auto& [a, b] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
            const double trial = symmetric_energy(r[0] + a * step, r[1] + b * step, element);
            if (trial < energy) {
                energy = trial;
                r[0] += a * step;
                r[1] += b * step;
                better = true;
            }
        }
        step = better ? step : step / 2;
    }
    return energy;
}

TEST(Embedding, AgreesWithTheSymmetricBallInClosedForm)
{
    for (const Element& element : {Element{}, Element{80, 96, radians(60)}, Element{120, 140, radians(66)}}) {
        Surface surface = shapes::ball_surface(0, element);
        const EmbedReport report = embed(surface, element);
        EXPECT_NEAR(report.energy, smallest_symmetric_energy(element), 1e-9 * report.energy);
    }
}

TEST(Embedding, ConvergesOnEveryShapeOfTheLibrary)
{
    const Element element;
    for (const std::string& name : base_shape_names()) {
        Surface surface = base_shape(name, element).value().surface;
        const EmbedReport report = embed(surface, element);
        EXPECT_TRUE(report.converged) << name << ": " << report.message << ", gradient " << report.gradient_norm;
        EXPECT_LE(report.gradient_norm, 1e-8) << name;
        EXPECT_LE(measure(surface, element).gradient_norm, 1e-8) << name;
    }
}

TEST(Embedding, ConvergesForOtherElements)
{
    for (const Element& element :
         {Element{40, 41, radians(50)}, Element{200, 300, radians(60)}, Element{60, 84, radians(80)}}) {
        for (const char* name : {"ball-30", "ball-90", "polar-5x4", "checker-24", "tube-6x6"}) {
            Surface surface = base_shape(name, element).value().surface;
            EXPECT_TRUE(embed(surface, element).converged) << name << " " << element.la;
        }
    }
}

TEST(Embedding, MeasureAgreesWithTheReport)
{
    Surface surface = shapes::ball_surface(1);
    const EmbedReport embedded = embed(surface, {});
    const EmbedReport measured = measure(surface, {});
    EXPECT_NEAR(measured.energy, embedded.energy, 1e-9);
    EXPECT_NEAR(measured.max_stretch, embedded.max_stretch, 1e-12);
    EXPECT_TRUE(measured.converged);
}

TEST(Embedding, LeavesAnEquilibriumWhereItIs)
{
    Surface surface = settled_ball(1);
    const Surface before = surface;
    EXPECT_EQ(embed(surface, {}).iterations, 0);
    EXPECT_LT(largest_distance(surface, before), 1e-9);
}

TEST(Embedding, DoesNotDependOnPoseOrUnit)
{
    Surface surface = settled_ball(0);
    const double energy = measure(surface, {}).energy;
    const Eigen::AngleAxisd turn(1.1, Vec3(1, 2, 3).normalized());
    Surface moved = shapes::ball_surface(0);
    transform(moved, [&](const Vec3& p) { return Vec3(turn * p + Vec3(500, -900, 40)); });
    EXPECT_NEAR(embed(moved, {}).energy, energy, 1e-9);
    Surface larger = shapes::ball_surface(0, {160, 176});
    EXPECT_NEAR(embed(larger, {160, 176}).energy, 2 * energy, 1e-9);
}

TEST(Embedding, KeepsThePoseOfTheInput)
{
    const Surface settled = settled_ball(1);
    Surface surface = settled;
    shapes::add_noise(surface, 4, 5);
    const Surface noisy = surface;
    ASSERT_TRUE(embed(surface, {}).converged);
    // The noise itself turns and shifts the best fit by its mean, which is small for 122 vertices.
    EXPECT_LT(largest_distance(surface, settled), 4);
    EXPECT_LT(largest_distance(surface, noisy), 30);
}

// Two elements that share an edge, at rest in the plane.
Surface two_elements()
{
    SurfaceLists lists;
    lists.positions = {{0, 0, 0}, {80, 0, 0}, {120, 70, 0}, {40, 70, 0}, {120, -70, 0}, {40, -70, 0}};
    lists.quads = {{0, 1, 2, 3}, {0, 5, 4, 1}};
    for (int v = 0; v < 6; ++v) {
        lists.sides.push_back(v % 2 == 0 ? Side::Long : Side::Short);
    }
    lists.facing.assign(2, Facing::Front);
    lists.component.assign(2, 0);
    lists.serial.assign(2, -1);
    Surface surface = make_surface(lists).value();
    EXPECT_TRUE(embed(surface, {}).converged);
    return surface;
}

// Beyond 2.4 rad a ridge opens a hinge on the way to an equilibrium; one that has come to rest there is at rest.
TEST(Embedding, LeavesASharpFoldThatIsAtRest)
{
    Surface surface = two_elements();
    const Vec3 origin = surface.point(Vertex(0));
    const Vec3 edge = (surface.point(Vertex(1)) - origin).normalized();
    const Eigen::AngleAxisd fold(2.5, edge);
    for (const int v : {4, 5}) {
        surface.set_point(Vertex(v), origin + fold * (surface.point(Vertex(v)) - origin));
    }
    const Surface folded = surface;
    shapes::add_noise(surface, 1e-3, 1);
    EmbedOptions options;
    options.start = Start::Edited;
    const EmbedReport report = embed(surface, {}, options);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.guard_energy, 0);
    EXPECT_LT(largest_distance(surface, folded), 0.05);
}

TEST(Embedding, MovesOnlyWhatAnEditReaches)
{
    const Surface settled = settled_ball(2);
    Surface surface = settled;
    surface.set_point(Vertex(7), surface.point(Vertex(7)) + Vec3(14, 14, 14));
    const EmbedReport report = embed(surface, {});
    EXPECT_TRUE(report.converged);
    EXPECT_LT(largest_distance(surface, settled),
              0.3); // the fit to the edited pose moves all by 24 mm / 482, and turns
}

TEST(Embedding, GivesTheSameBytesWithAnyNumberOfThreads)
{
    for (const int level : {3, 4}) { // the second one counts as large
        std::vector<Surface> results;
        for (const int threads : {1, 2, 3}) {
            Surface& surface = results.emplace_back(shapes::ball_surface(level));
            EmbedOptions options;
            options.threads = threads;
            ASSERT_TRUE(embed(surface, {}, options).converged);
        }
        EXPECT_EQ(largest_distance(results[0], results[1]), 0);
        EXPECT_EQ(largest_distance(results[0], results[2]), 0);
    }
}

TEST(Embedding, RefusesWhatIsNoPosition)
{
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e308}) {
        Surface surface = shapes::ball_surface(0);
        surface.set_point(Vertex(3), Vec3(0, bad, 0));
        const EmbedReport report = embed(surface, {});
        EXPECT_FALSE(report.converged);
        EXPECT_NE(report.message.find("vertex 3"), std::string::npos) << report.message;
        EXPECT_FALSE(measure(surface, {}).converged);
    }
}

TEST(Embedding, StopsWhenToldAndDeliversTheBestSoFar)
{
    Surface surface = shapes::ball_surface(2);
    shapes::add_noise(surface, 8, 1);
    const double before = measure(surface, {}).energy;
    EmbedOptions options;
    int calls = 0;
    options.progress = [&](const EmbedProgress&) { return ++calls < 5; };
    const EmbedReport report = embed(surface, {}, options);
    EXPECT_EQ(calls, 5);
    EXPECT_FALSE(report.converged);
    EXPECT_LT(report.energy, before);
    EXPECT_NEAR(measure(surface, {}).energy, report.energy, 1e-6 * report.energy);
    EXPECT_NE(report.message, "");
}

TEST(Embedding, KeepsItsTimeBudget)
{
    Surface surface = shapes::ball_surface(4);
    shapes::add_noise(surface, 8, 1);
    EmbedOptions options;
    options.time_budget_s = 0.02;
    const EmbedReport report = embed(surface, {}, options);
    EXPECT_FALSE(report.converged);
    EXPECT_LT(report.iterations, 400);
}

// Starts that other solvers break on: each must find the ball's known energy.
struct BadStart
{
    const char* name;
    std::function<void(Surface&)> apply;
};

TEST(Embedding, FindsTheBallFromStartsThatKnowNothing)
{
    const BadStart starts[] = {
        {"all in one point", [](Surface& s) { transform(s, [](const Vec3&) { return Vec3(1, 2, 3); }); }},
        {"in a plane", [](Surface& s) { transform(s, [](const Vec3& p) { return Vec3(p.x(), p.y(), 0); }); }},
        {"a needle", [](Surface& s) { transform(s, [](const Vec3& p) { return Vec3(p.x(), 0, 0); }); }},
        {"inside out", [](Surface& s) { transform(s, [](const Vec3& p) { return Vec3(-p); }); }},
        {"tiny", [](Surface& s) { transform(s, [](const Vec3& p) { return Vec3(1e-9 * p); }); }},
        {"huge", [](Surface& s) { transform(s, [](const Vec3& p) { return Vec3(1e5 * p); }); }},
        {"two vertices in one", [](Surface& s) { s.set_point(Vertex(0), s.point(Vertex(25))); }},
        {"noise of half an edge", [](Surface& s) { shapes::add_noise(s, 40, 3); }},
        {"a cloud", [](Surface& s) {
             transform(s, [](const Vec3&) { return Vec3(0, 0, 0); });
             shapes::add_noise(s, 80, 4);
         }}};
    for (const int level : {0, 1}) {
        const double energy = measure(settled_ball(level), {}).energy;
        for (const BadStart& start : starts) {
            Surface surface = shapes::ball_surface(level);
            start.apply(surface);
            const EmbedReport report = embed(surface, {});
            EXPECT_TRUE(report.converged) << start.name << ": " << report.message;
            EXPECT_NEAR(report.energy, energy, 1e-6 * energy) << start.name;
        }
    }
}

TEST(Embedding, PopsADimple)
{
    const Surface settled = settled_ball(2);
    Surface surface = settled;
    double top = 0;
    for (const Vertex v : surface.vertices()) {
        top = std::max(top, surface.point(v).z());
    }
    // The cap above 3/4 of the height, mirrored inwards, is a state in which a thin shell can rest.
    transform(surface, [&](const Vec3& p) { return p.z() > 0.75 * top ? Vec3(p.x(), p.y(), 1.5 * top - p.z()) : p; });
    const EmbedReport report = embed(surface, {});
    EXPECT_NEAR(report.energy, measure(settled, {}).energy, 1e-6 * report.energy);
}

// A cloud knows nothing of the hole, and the slowest modes of a torus lie in a plane.
TEST(Embedding, FindsTheHoleOfATorusInACloud)
{
    for (const char* name : {"torus-12x6", "torus-16x6"}) {
        Surface settled = base_shape(name, {}).value().surface;
        const double energy = embed(settled, {}).energy;
        for (const unsigned seed : {1, 2}) {
            Surface surface = settled;
            transform(surface, [](const Vec3&) { return Vec3(0, 0, 0); });
            shapes::add_noise(surface, 150, seed);
            const EmbedReport report = embed(surface, {});
            EXPECT_TRUE(report.converged) << name << " " << seed << ": " << report.message;
            EXPECT_NEAR(report.energy, energy, 1e-6 * energy) << name << " " << seed;
        }
    }
}

TEST(Embedding, UnfoldsASheet)
{
    for (const unsigned seed : {0, 2, 3, 4, 8, 9, 10}) {
        Surface surface = base_shape("sheet-4x4", {}).value().surface;
        shapes::add_noise(surface, seed == 0 ? 0 : 40, seed);
        const EmbedReport report = embed(surface, {});
        EXPECT_TRUE(report.converged) << seed << ": " << report.message;
        EXPECT_EQ(report.guard_energy, 0) << seed;
    }
}

TEST(Embedding, LeavesTheThirdDimensionToASheet)
{
    Surface surface = base_shape("sheet-4x4", {}).value().surface;
    transform(surface, [](const Vec3& p) { return Vec3(p.x(), p.y(), 0); });
    ASSERT_TRUE(embed(surface, {}).converged);
    double height = 0;
    for (const Vertex v : surface.vertices()) {
        height = std::max(height, std::abs(surface.point(v).z()));
    }
    EXPECT_GT(height, 1);
}

} // namespace
} // namespace rhombloom
