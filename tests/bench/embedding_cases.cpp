#include "tests/bench/embedding_cases.h"

#include "core/design/history.h"
#include "core/form/minimise.h"
#include "core/model/base_shapes.h"
#include "tests/bench/examples.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom::bench {

namespace {

constexpr double noise = 0.1; // la

Start start_from(const Surface& surface, const Element& element)
{
    Start start;
    start.terms = embedding_terms(surface, element, {});
    start.x.resize(3 * start.terms.vertex_count);
    for (const Vertex v : surface.vertices()) {
        start.x.segment<3>(3 * v.idx()) = surface.point(v) / element.la;
    }
    return start;
}

Start noisy(Surface surface, const Element& element, unsigned seed)
{
    shapes::add_noise(surface, noise * element.la, seed);
    return start_from(surface, element);
}

Start moved_vertex(const Surface& surface, unsigned seed)
{
    Start start = start_from(surface, {});
    Iterate iterate = iterate_at(start.terms, start.x);
    minimise(start.terms, iterate, {});
    start.x = iterate.x;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const int v = static_cast<int>(random() % start.terms.vertex_count);
    const Vec3 move(normal(random), normal(random), normal(random));
    start.x.segment<3>(3 * v) += 0.3 * move.normalized();
    return start;
}

Surface joined(const shapes::Triangulation& mesh)
{
    return make_surface(shapes::join(mesh, {})).value();
}

void add_balls(std::vector<Case>& out)
{
    for (int level = 0; level <= 6; ++level) {
        const std::string size = std::to_string(30 << (2 * level));
        const int repeats = level < 4 ? 5 : 1;
        const double limit = level < 5 ? 60 : 300;
        out.push_back({"plain-" + size, [=](unsigned) { return start_from(shapes::ball_surface(level), {}); }, repeats,
                       limit, level < 6});
        if (level < 6) {
            out.push_back({"noise-" + size, [=](unsigned seed) { return noisy(shapes::ball_surface(level), {}, seed); },
                           repeats, limit, true});
        }
    }
}

void add_models(std::vector<Case>& out)
{
    for (const std::string& name : example_names()) {
        out.push_back({"model-" + name, [name](unsigned seed) {
                           const Design design = example(name);
                           return noisy(replay(design).value().surface, design.element, seed);
                       }});
    }
}

} // namespace

std::vector<Case> cases()
{
    std::vector<Case> out;
    add_balls(out);
    for (const int level : {0, 1, 2, 3}) {
        out.push_back({"move-" + std::to_string(30 << (2 * level)),
                       [=](unsigned seed) { return moved_vertex(shapes::ball_surface(level), seed); }});
    }
    out.push_back(
        {"move-588", [](unsigned seed) { return moved_vertex(base_shape("checker-588", {}).value().surface, seed); }});
    out.push_back({"torus-600", [](unsigned seed) { return noisy(joined(shapes::torus(20, 10)), {}, seed); }});
    out.push_back({"capsule-600", [](unsigned seed) { return noisy(joined(shapes::capsule(4, 2)), {}, seed); }});
    add_models(out);
    return out;
}

} // namespace rhombloom::bench
