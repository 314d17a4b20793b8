// The published models: as many elements as the paper's, few operations, embedded, buildable, lamps, symmetric.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "core/design/design_file.h"
#include "core/design/history.h"
#include "core/design/overlap.h"
#include "core/model/angular_defect.h"
#include "core/model/validity.h"

namespace rhombloom {
namespace {

struct Model
{
    const char* name;
    int elements; //!< of the paper's model
};

class Example : public testing::TestWithParam<Model>
{
};

Design read(const std::string& name)
{
    std::ifstream file(RHOMBLOOM_SOURCE_DIR "/examples/" + name + ".json");
    std::ostringstream text;
    text << file.rdbuf();
    return parse_design(text.str()).value();
}

std::vector<double> coordinates(const Surface& surface)
{
    std::vector<double> result;
    for (const Vertex v : surface.vertices()) {
        const Vec3& p = surface.point(v);
        result.insert(result.end(), {p.x(), p.y(), p.z()});
    }
    return result;
}

//! The farthest that an image of a vertex lies from any vertex, mm.
double asymmetry(const Surface& surface, const Symmetry& symmetry)
{
    double worst = 0;
    for (const SymmetryImage& image : images(symmetry)) {
        for (const Vertex v : surface.vertices()) {
            double nearest = 1e300;
            for (const Vertex w : surface.vertices()) {
                nearest = std::min(nearest, (surface.point(w) - image.map * surface.point(v)).norm());
            }
            worst = std::max(worst, nearest);
        }
    }
    return worst;
}

//! The operations before the first opening. At a rim every edge is long or short, and a mirror exchanges the two: no
//! surface with a rim is its own mirror image to the last digit.
std::size_t closed_stages(const Design& design)
{
    const auto is_open = [](const Operation& operation) { return std::holds_alternative<Open>(operation); };
    const auto first = std::find_if(design.operations.begin(), design.operations.end(), is_open);
    return static_cast<std::size_t>(first - design.operations.begin());
}

bool has_purpose(const Design& design, const std::string& purpose)
{
    return std::any_of(design.operations.begin(), design.operations.end(), [&](const Operation& operation) {
        const Open* open = std::get_if<Open>(&operation);
        return open != nullptr && open->purpose == purpose;
    });
}

TEST_P(Example, CanBeBuiltAsALamp)
{
    const Design design = read(GetParam().name);
    EXPECT_LE(design.operations.size(), 20u);
    EXPECT_TRUE(has_purpose(design, "lamp holder"));
    EXPECT_TRUE(has_purpose(design, "bulb hatch"));
    const auto made = replay(design);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_NEAR(static_cast<double>(made->surface.n_faces()), GetParam().elements, 0.05 * GetParam().elements);
    EXPECT_TRUE(made->embedding.converged);
    EXPECT_LE(made->embedding.max_stretch, 0.01);
    EXPECT_TRUE(validate(made->surface, design.element).ok());
    EXPECT_FALSE(crosses_itself(made->surface));
    EXPECT_GE(defect_range(made->surface, design.element).min, permissible_defect(design.element).min + radians(10));
    if (design.symmetry.kind != Symmetry::Kind::None) {
        const Surface& closed = made->stages[closed_stages(design) - 1].surface;
        EXPECT_LT(asymmetry(closed, design.symmetry), 1e-3 * design.element.la);
    }
}

TEST_P(Example, ReplayedTwiceGivesTheSameBytes)
{
    const Design design = read(GetParam().name);
    const auto first = replay(design);
    const auto second = replay(*parse_design(write_design(design)));
    ASSERT_TRUE(first.has_value() && second.has_value());
    EXPECT_EQ(coordinates(first->surface), coordinates(second->surface));
    EXPECT_EQ(lists(first->surface).quads, lists(second->surface).quads);
    EXPECT_EQ(write_design(*parse_design(write_design(design))), write_design(design));
}

INSTANTIATE_TEST_SUITE_P(Models, Example,
                         testing::Values(Model{"turtle", 123}, Model{"pig", 187}, Model{"flower", 288},
                                         Model{"bunny", 188}, Model{"chandelier", 440}, Model{"dancer", 215},
                                         Model{"elephant", 588}, Model{"snake", 117}),
                         [](const auto& model) { return model.param.name; });

} // namespace
} // namespace rhombloom
