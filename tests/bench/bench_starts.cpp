// bench_starts [RUNS] [SHAPE ...]: from which starts the embedding reaches the best energy that any of them found.
// Every library shape and every example design (or those named, a design as model-NAME) from the generator's positions
// (a design: as it is replayed), from RUNS (10) starts with 0.1 and 0.5 la of noise per coordinate and from RUNS clouds
// of the shape's size. Prints how many converge (no gradient component over
// 1e-8) and how many come within 1e-6 of the best energy, per shape and in all. Shapes that rest on a guard (a sheet
// folded sharply) are in no equilibrium of the energy and do not count, unless none of the runs does without
// (elephant).

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>

#include "core/design/history.h"
#include "core/form/embedding.h"
#include "core/model/base_shapes.h"
#include "tests/bench/examples.h"
#include "tests/core/form/triangulations.h"

namespace rhombloom {
namespace {

struct Outcome
{
    bool converged = false;
    bool guarded = false; // in equilibrium only with a guard
    double energy = 0;
};

Outcome outcome(Surface surface, const Element& element)
{
    embed(surface, element);
    const EmbedReport report = measure(surface, element);
    return {report.gradient_norm <= 1e-8, report.guard_energy > 0, report.energy + report.guard_energy};
}

Surface noisy(Surface surface, double sigma, unsigned seed) // mm
{
    shapes::add_noise(surface, sigma, seed);
    return surface;
}

// Normally distributed, as far from the centre on average as the shape's own vertices.
Surface cloud(Surface surface, unsigned seed)
{
    Vec3 centre = Vec3::Zero();
    for (const Vertex v : surface.vertices()) {
        centre += surface.point(v) / double(surface.n_vertices());
    }
    double square = 0;
    for (const Vertex v : surface.vertices()) {
        square += (surface.point(v) - centre).squaredNorm() / double(surface.n_vertices());
        surface.set_point(v, Vec3::Zero());
    }
    shapes::add_noise(surface, std::sqrt(square / 3), seed);
    return surface;
}

using Outcomes = std::map<std::string, std::vector<Outcome>>; // by kind of start

constexpr const char* model = "model-";

Outcomes outcomes(const std::string& name, unsigned runs)
{
    const bool is_model = name.starts_with(model);
    const Design design = is_model ? bench::example(name.substr(std::strlen(model))) : Design{};
    const Surface surface = is_model ? replay(design).value().surface : base_shape(name, {}).value().surface;
    const double la = design.element.la;
    Outcomes out;
    out["generator"] = {outcome(surface, design.element)};
    for (unsigned seed = 1; seed <= runs; ++seed) {
        out["noise 0.1"].push_back(outcome(noisy(surface, 0.1 * la, seed), design.element));
        out["noise 0.5"].push_back(outcome(noisy(surface, 0.5 * la, seed), design.element));
        out["cloud"].push_back(outcome(cloud(surface, seed), design.element));
    }
    return out;
}

std::vector<std::string> all_names()
{
    std::vector<std::string> names = base_shape_names();
    for (const std::string& example : bench::example_names()) {
        names.push_back(model + example);
    }
    return names;
}

// Is there a start from which the shape stands without guards?
bool stands_alone(const Outcomes& all)
{
    return std::any_of(all.begin(), all.end(), [](const auto& entry) {
        return std::any_of(entry.second.begin(), entry.second.end(),
                           [](const Outcome& o) { return o.converged && !o.guarded; });
    });
}

double lowest(const Outcomes& all, bool guards_allowed)
{
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [start, list] : all) {
        for (const Outcome& o : list) {
            best = o.converged && (guards_allowed || !o.guarded) ? std::min(best, o.energy) : best;
        }
    }
    return best;
}

struct Sum
{
    int runs = 0;
    int converged = 0;
    int best = 0;
};

Sum count(const std::vector<Outcome>& list, double best, bool guards_allowed)
{
    Sum sum;
    for (const Outcome& o : list) {
        ++sum.runs;
        sum.converged += o.converged;
        sum.best += (guards_allowed || !o.guarded) && o.energy <= best + 1e-6 * std::abs(best) + 1e-9;
    }
    return sum;
}

void print(const char* name, const std::map<std::string, Sum>& sums)
{
    std::printf("%-16s", name);
    for (const char* start : {"generator", "noise 0.1", "noise 0.5", "cloud"}) {
        const Sum& sum = sums.at(start);
        std::printf("  %5d %5d of %-5d", sum.converged, sum.best, sum.runs);
    }
    std::printf("\n");
    std::fflush(stdout);
}

} // namespace
} // namespace rhombloom

int main(int argc, char** argv)
{
    using namespace rhombloom;
    const unsigned runs = argc > 1 ? unsigned(std::max(1, std::atoi(argv[1]))) : 10;
    std::vector<std::string> names(argv + std::min(argc, 2), argv + argc);
    names = names.empty() ? all_names() : names;
    std::printf("converged, best energy; from    %-21s%-21s%-21s%s\n", "generator", "noise 0.1 la", "noise 0.5 la",
                "cloud");
    std::map<std::string, Sum> total;
    for (const std::string& name : names) {
        const Outcomes all = outcomes(name, runs);
        const bool guards_allowed = !stands_alone(all);
        const double best = lowest(all, guards_allowed);
        std::map<std::string, Sum> sums;
        for (const auto& [start, list] : all) {
            const Sum sum = sums[start] = count(list, best, guards_allowed);
            total[start].runs += sum.runs;
            total[start].converged += sum.converged;
            total[start].best += sum.best;
        }
        print(name.c_str(), sums);
    }
    print("in all", total);
}
