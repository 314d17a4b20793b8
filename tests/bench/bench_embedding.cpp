// bench_embedding [--fast] [CASE ...]: the embedding's solver against general ones on the same energy, in one run, on
// one thread. Prints processor time (medians of the repeats) until the energy is within 1e-6 of the best that anybody
// found and until no gradient component exceeds 1e-8. CASE: a name or the beginning of one;
// --fast: without Ceres and projected Newton.

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>

#include "tests/bench/embedding_rivals.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom::bench {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

struct Start
{
    EmbeddingTerms terms;
    Eigen::VectorXd x;
};

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

Start noisy(const shapes::Triangulation& mesh, double noise, unsigned seed)
{
    const Element element;
    Surface surface = make_surface(shapes::join(mesh, element)).value();
    shapes::add_noise(surface, noise * element.la, seed);
    return start_from(surface, element);
}

Start moved_vertex(const shapes::Triangulation& mesh, unsigned seed)
{
    Start start = noisy(mesh, 0, 0);
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

struct Case
{
    std::string name;
    std::function<Start(unsigned seed)> make;
    int repeats = 5;
    double limit_s = 60;
    bool slow_rivals = true;
};

shapes::Triangulation sphere(int level)
{
    shapes::Triangulation mesh = shapes::icosahedron();
    for (int k = 0; k < level; ++k) {
        mesh = shapes::subdivided(mesh);
    }
    return mesh;
}

std::vector<Case> cases()
{
    std::vector<Case> out;
    for (int level = 0; level <= 4; ++level) {
        const int elements = 30 << (2 * level);
        out.push_back({"noise-" + std::to_string(elements),
                       [=](unsigned seed) { return noisy(sphere(level), 0.1, seed); }, level < 4 ? 5 : 1, 60.0,
                       level < 4});
    }
    for (int level = 0; level <= 6; ++level) {
        const int elements = 30 << (2 * level);
        out.push_back({"plain-" + std::to_string(elements), [=](unsigned) { return noisy(sphere(level), 0, 0); },
                       level < 4 ? 5 : 1, level < 5 ? 60.0 : 300.0, level < 4});
    }
    for (int level = 0; level <= 3; ++level) {
        const int elements = 30 << (2 * level);
        out.push_back({"move-" + std::to_string(elements),
                       [=](unsigned seed) { return moved_vertex(sphere(level), seed); }, 5, 60, true});
    }
    out.push_back({"move-capsule-600", [](unsigned seed) { return moved_vertex(shapes::capsule(4, 2), seed); }});
    out.push_back({"capsule-600", [](unsigned seed) { return noisy(shapes::capsule(4, 2), 0.1, seed); }});
    out.push_back({"torus-600", [](unsigned seed) { return noisy(shapes::torus(20, 10), 0.1, seed); }});
    return out;
}

struct Result
{
    std::vector<double> to_energy, to_gradient;
    double energy = never;
};

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? never : values[values.size() / 2];
}

double first_time(const Trace& trace, const std::function<bool(const Sample&)>& reached)
{
    const auto found = std::find_if(trace.begin(), trace.end(), reached);
    return found == trace.end() ? never : found->seconds;
}

std::vector<Solver> solvers(const Case& test)
{
    std::vector<Solver> out = {ours(), liblbfgs()};
    if (test.slow_rivals) {
        for (const Solver& rival : {projected_newton(), ceres_levenberg_marquardt(), ceres_dogleg()}) {
            out.push_back(rival);
        }
    }
    return out;
}

void print_row(const std::string& name, const Result& result, const Result& reference)
{
    const double energy = median(result.to_energy);
    const double gradient = median(result.to_gradient);
    std::printf("  %-30s %10.2f %12.2f %12.2f %12.2f\n", name.c_str(), 1e3 * energy, 1e3 * gradient,
                energy / median(reference.to_energy), energy / median(reference.to_gradient));
    std::fflush(stdout);
}

void run(const Case& test)
{
    const std::vector<Solver> all = solvers(test);
    std::vector<Result> results(all.size());
    for (int repeat = 0; repeat < test.repeats; ++repeat) {
        const Start start = test.make(repeat + 1);
        std::vector<Trace> traces;
        double best = never;
        for (const Solver& solver : all) {
            traces.push_back(solver.run(start.terms, start.x, test.limit_s));
            for (const Sample& sample : traces.back()) {
                best = std::min(best, sample.energy);
            }
        }
        for (std::size_t k = 0; k < all.size(); ++k) {
            results[k].to_energy.push_back(
                first_time(traces[k], [&](const Sample& s) { return s.energy <= best * (1 + 1e-6); }));
            results[k].to_gradient.push_back(
                first_time(traces[k], [](const Sample& s) { return s.gradient_norm <= 1e-8; }));
        }
    }
    std::printf("%s\n  %-30s %10s %12s %12s %12s\n", test.name.c_str(), "", "1e-6 (ms)", "1e-8 (ms)", "1e-6 : ours",
                "1e-6 : 1e-8 ours");
    for (std::size_t k = 0; k < all.size(); ++k) {
        print_row(all[k].name, results[k], results[0]);
    }
}

bool is_fast(int argc, char** argv)
{
    return std::any_of(argv + 1, argv + argc, [](const char* word) { return std::strcmp(word, "--fast") == 0; });
}

bool is_wanted(const Case& test, int argc, char** argv)
{
    return argc == 1 + is_fast(argc, argv) || std::any_of(argv + 1, argv + argc, [&](const char* wanted) {
               return test.name.compare(0, std::strlen(wanted), wanted) == 0;
           });
}

} // namespace
} // namespace rhombloom::bench

int main(int argc, char** argv)
{
    omp_set_max_active_levels(0); // CHOLMOD's teams make Ceres slower, not faster
    omp_set_num_threads(1);
    for (auto test : rhombloom::bench::cases()) {
        test.slow_rivals = test.slow_rivals && !rhombloom::bench::is_fast(argc, argv);
        if (rhombloom::bench::is_wanted(test, argc, argv)) {
            rhombloom::bench::run(test);
        }
    }
}
