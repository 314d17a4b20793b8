// How often merge and extrude succeed, how close they stay to what was asked, and how long the candidates take.
//
//   bench_design merge SHAPE SHAPE [POSES] [NEAREST] [FARTHEST]   distances of the centres in la
//   bench_design extrude [EVERY]                                  every EVERY-th vertex of every closed shape
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "core/design/extrude.h"
#include "core/design/merge.h"
#include "core/design/overlap.h"
#include "core/design/pose.h"
#include "core/model/validity.h"

namespace rhombloom {
namespace {

const Element element;

BaseShape embedded(const std::string& name)
{
    BaseShape shape = base_shape(name, element).value();
    embed_in_place(shape.surface, element, {});
    return shape;
}

Surface posed(const Surface& surface, const Vec3& offset, const Eigen::Quaterniond& turn)
{
    Surface result = surface;
    for (const Vertex v : result.vertices()) {
        result.set_point(v, offset + turn * result.point(v));
    }
    return result;
}

//! Root mean square distance of the result's vertices from the boundary of the union, in la.
double distance_from_union(const Surface& result, const Surface& a, const Surface& b)
{
    double sum = 0;
    for (const Vertex v : result.vertices()) {
        const Vec3 p = result.point(v);
        sum += std::pow(std::min(signed_distance(a, p), signed_distance(b, p)), 2);
    }
    return std::sqrt(sum / static_cast<double>(result.n_vertices())) / element.la;
}

struct MergeCounts
{
    int paper = 0, full = 0, settled = 0, close = 0;
    double milliseconds = 0; //!< for the candidates
};

void count_pose(const Surface& a, const Surface& b, MergeCounts& counts)
{
    MergeOptions options;
    options.embedding.threads = 1;
    counts.paper += four_candidates(a, b, element, options) ? 1 : 0;
    const auto start = std::chrono::steady_clock::now();
    const bool found = merge_candidates(a, b, element, options).has_value();
    counts.milliseconds += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    counts.full += found ? 1 : 0;
    if (const auto merged = merge(a, b, element, 0, options)) {
        counts.settled += settled(merged->embedding) ? 1 : 0;
        counts.close += distance_from_union(merged->surface, a, b) <= 0.5 ? 1 : 0;
    }
}

int bench_merge(const std::string& first, const std::string& second, int poses, double nearest, double farthest)
{
    const Surface a = embedded(first).surface;
    const Surface b = embedded(second).surface;
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> range(nearest, farthest);
    MergeCounts counts;
    for (int i = 0; i < poses; ++i) {
        const Eigen::Vector4d q(normal(random), normal(random), normal(random), normal(random));
        const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
        count_pose(a, posed(b, range(random) * element.la * direction, Eigen::Quaterniond(q.normalized())), counts);
    }
    std::printf("%s + %s, %d poses: four candidates %.1f %%, merge %.1f %%, settled %.1f %%, within 0.5 la rms of the "
                "union %.1f %%, candidates %.1f ms\n",
                first.c_str(), second.c_str(), poses, 100.0 * counts.paper / poses, 100.0 * counts.full / poses,
                100.0 * counts.settled / poses, 100.0 * counts.close / poses, counts.milliseconds / poses);
    return 0;
}

Vec3 outward(const Surface& surface, Vertex v)
{
    Vec3 n = Vec3::Zero();
    for (const Face f : surface.vf_range(v)) {
        const Quad q = quad(surface, f);
        const auto at = [&](int k) { return surface.point(Vertex(q[k])); };
        n += (at(2) - at(0)).cross(at(3) - at(1)).normalized();
    }
    return n.normalized();
}

int bench_extrude(int every)
{
    int tried = 0;
    int made = 0;
    int follows = 0;
    int vertex = 0;
    for (const std::string& target_name : base_shape_names()) {
        const BaseShape target = embedded(target_name);
        if (validate(target.surface, element).boundary_loops > 0) {
            continue;
        }
        for (const std::string& brush_name : base_shape_names()) {
            const BaseShape brush = embedded(brush_name);
            for (const Vertex v : target.surface.vertices()) {
                if (brush.surface.n_faces() > 40 || vertex++ % every != 0) {
                    continue;
                }
                EmbedOptions embedding;
                embedding.threads = 1;
                const ExtrudeRequest request{v, 2 * element.la * outward(target.surface, v), "limb", {}};
                const auto result = extrude(target.surface, element, brush, request, embedding);
                ++tried;
                made += result ? 1 : 0;
                follows += result && result->reached.normalized().dot(request.drag.normalized()) > std::cos(pi / 6);
            }
        }
    }
    std::printf("extrude, %d apexes: %.1f %% succeed, %.1f %% of the tips within 30 degrees of the drag\n", tried,
                100.0 * made / tried, 100.0 * follows / tried);
    return 0;
}

} // namespace
} // namespace rhombloom

int main(int argc, char** argv)
{
    const auto number = [&](int i, double fallback) { return argc > i ? std::atof(argv[i]) : fallback; };
    if (argc >= 4 && std::string(argv[1]) == "merge") {
        return rhombloom::bench_merge(argv[2], argv[3], static_cast<int>(number(4, 200)), number(5, 1.4),
                                      number(6, 2.4));
    }
    if (argc >= 2 && std::string(argv[1]) == "extrude") {
        return rhombloom::bench_extrude(std::max(1, static_cast<int>(number(2, 1))));
    }
    std::fprintf(stderr, "usage: bench_design merge SHAPE SHAPE [POSES NEAREST FARTHEST] | extrude [EVERY]\n");
    return 2;
}
