// How often merge and extrude succeed, how close they stay to what was asked, and how long they take.
//
//   bench_design merge SHAPE SHAPE [POSES] [NEAREST] [FARTHEST]   distances of the centres in la
//   bench_design pairs [POSES] [LARGEST]                          random pairs of different closed library shapes
//   bench_design extrude [EVERY]                                  every EVERY-th vertex of every closed shape
//   bench_design time [POSES] [TARGET]                            on a large target
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>

#include "core/design/extrude.h"
#include "core/design/merge.h"
#include "core/design/overlap.h"
#include "tests/core/design/shapes.h"

namespace rhombloom {
namespace {

const Element element;

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

//! Milliseconds of processor time that \p work takes: other programs on the machine do not count, nothing here
//! waits, and one thread is used.
template <class Work>
double milliseconds(const Work& work)
{
    const std::clock_t start = std::clock();
    work();
    return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double share(std::vector<double> values, double part)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

class Poses
{
public:
    Vec3 direction() { return Vec3(normal_(random_), normal_(random_), normal_(random_)).normalized(); }

    Eigen::Quaterniond rotation()
    {
        const Eigen::Vector4d q(normal_(random_), normal_(random_), normal_(random_), normal_(random_));
        return Eigen::Quaterniond(q.normalized());
    }

    double between(double least, double most) { return std::uniform_real_distribution<double>(least, most)(random_); }
    int below(std::size_t n) { return static_cast<int>(random_() % n); }

private:
    std::mt19937 random_{7};
    std::normal_distribution<double> normal_;
};

struct MergeCounts
{
    int poses = 0, paper = 0, full = 0, settled = 0, close = 0;
    std::vector<double> candidates, merged; //!< milliseconds
};

MergeOptions merge_options()
{
    MergeOptions options;
    options.embedding.threads = 1;
    return options;
}

void count_pose(const Surface& a, const Surface& b, const std::string& name, MergeCounts& counts)
{
    ++counts.poses;
    counts.paper += four_candidates(a, b, element, merge_options()) ? 1 : 0;
    bool found = false;
    counts.candidates.push_back(
        milliseconds([&] { found = merge_candidates(a, b, element, merge_options()).has_value(); }));
    counts.full += found ? 1 : 0;
    Expected<Merged> merged = refuse("");
    counts.merged.push_back(milliseconds([&] { merged = merge(a, b, element, 0, merge_options()); }));
    const double distance = merged ? distance_from_union(merged->surface, a, b) : 1e300;
    counts.settled += merged && settled(merged->embedding) ? 1 : 0;
    counts.close += distance <= 0.5 ? 1 : 0;
    if (distance > 0.5 && std::getenv("VERBOSE")) {
        std::printf("pose %d (%s): %s, %.2f la\n", counts.poses - 1, name.c_str(),
                    merged ? "far" : merged.error().message.c_str(), merged ? distance : 0);
    }
}

void print(const std::string& what, const MergeCounts& counts)
{
    const auto percent = [&](int count) { return 100.0 * count / counts.poses; };
    std::printf("%s, %d poses: four candidates %.1f %%, merge %.1f %%, settled %.1f %%, within 0.5 la rms of the union "
                "%.1f %%; candidates median %.1f, 95 %% %.1f ms; merge median %.1f, 95 %% %.1f ms\n",
                what.c_str(), counts.poses, percent(counts.paper), percent(counts.full), percent(counts.settled),
                percent(counts.close), share(counts.candidates, 0.5), share(counts.candidates, 0.95),
                share(counts.merged, 0.5), share(counts.merged, 0.95));
}

int bench_merge(const std::string& first, const std::string& second, int count, double nearest, double farthest)
{
    const Surface a = shapes::embedded(first).surface;
    const Surface b = shapes::embedded(second).surface;
    Poses poses;
    MergeCounts counts;
    for (int i = 0; i < count; ++i) {
        const auto turn = poses.rotation();
        const Vec3 direction = poses.direction();
        count_pose(a, posed(b, poses.between(nearest, farthest) * element.la * direction, turn), second, counts);
    }
    print(first + " + " + second, counts);
    return 0;
}

double extent(const Surface& surface, const Vec3& direction)
{
    double farthest = 0;
    for (const Vertex v : surface.vertices()) {
        farthest = std::max(farthest, direction.dot(surface.point(v)));
    }
    return farthest;
}

//! \p b turned and moved so far along a direction that it overlaps \p a as much as 30-balls 1.4 to 2.4 la apart do.
Surface overlapping(const Surface& a, const Surface& b, Poses& poses)
{
    const Surface turned = posed(b, Vec3::Zero(), poses.rotation());
    const Vec3 direction = poses.direction();
    const double width_a = extent(a, direction) + extent(a, -direction);
    const double width_b = extent(turned, direction) + extent(turned, -direction);
    const double overlap = poses.between(0.23, 0.55) * std::min(width_a, width_b);
    const double away = extent(a, direction) + extent(turned, -direction) - overlap;
    return posed(turned, away * direction, Eigen::Quaterniond::Identity());
}

std::vector<std::string> closed_shapes(int largest)
{
    std::vector<std::string> names = shapes::small_shapes(largest);
    std::erase_if(names,
                  [](const std::string& name) { return !shapes::is_closed(base_shape(name, element)->surface); });
    return names;
}

int bench_pairs(int count, int largest)
{
    std::vector<BaseShape> library;
    for (const std::string& name : closed_shapes(largest)) {
        library.push_back(shapes::embedded(name));
    }
    Poses poses;
    MergeCounts counts;
    for (int i = 0; i < count; ++i) {
        const BaseShape& a = library[poses.below(library.size())];
        const BaseShape& b = library[poses.below(library.size())];
        const Surface moved = overlapping(a.surface, b.surface, poses);
        if (a.name == b.name || !overlap(a.surface, moved, 0).any) { // through the hole of a torus
            --i;
            continue;
        }
        count_pose(a.surface, moved, a.name + " + " + b.name, counts);
    }
    print("different closed shapes of at most " + std::to_string(largest) + " elements", counts);
    return 0;
}

ExtrudeRequest outward_request(const Surface& target, Vertex apex)
{
    return {apex, 2 * element.la * shapes::outward(target, apex), "limb", {}};
}

struct ExtrudeCounts
{
    int tried = 0, made = 0, settled = 0, follows = 0;
};

void count_apex(const BaseShape& target, const BaseShape& brush, Vertex apex, ExtrudeCounts& counts)
{
    const ExtrudeRequest request = outward_request(target.surface, apex);
    const auto result = extrude(target.surface, element, brush, request, merge_options().embedding);
    const double cosine = result ? result->reached.normalized().dot(request.drag.normalized()) : -1;
    ++counts.tried;
    counts.made += result ? 1 : 0;
    counts.settled += result && settled(result->embedding) ? 1 : 0;
    counts.follows += cosine > std::cos(pi / 6) ? 1 : 0;
    if (cosine <= std::cos(pi / 6) && std::getenv("VERBOSE")) {
        std::printf("%s vertex %d (valence %u) %s: %s\n", target.name.c_str(), apex.idx(), target.surface.valence(apex),
                    brush.name.c_str(),
                    result ? std::to_string(degrees(std::acos(cosine))).c_str() : result.error().message.c_str());
    }
}

int bench_extrude(int every)
{
    std::vector<BaseShape> brushes;
    for (const std::string& name : shapes::small_shapes(40)) {
        brushes.push_back(shapes::embedded(name));
    }
    ExtrudeCounts counts;
    int vertex = 0;
    for (const std::string& name : closed_shapes(1 << 20)) {
        const BaseShape target = shapes::embedded(name);
        for (const BaseShape& brush : brushes) {
            for (const Vertex v : target.surface.vertices()) {
                if (vertex++ % every == 0) {
                    count_apex(target, brush, v, counts);
                }
            }
        }
    }
    std::printf("extrude, %d apexes: %.1f %% succeed, %.1f %% settle, %.1f %% of the tips within 30 degrees of the "
                "drag\n",
                counts.tried, 100.0 * counts.made / counts.tried, 100.0 * counts.settled / counts.tried,
                100.0 * counts.follows / counts.tried);
    return 0;
}

int bench_time(int count, const std::string& name)
{
    const BaseShape target = shapes::embedded(name);
    std::vector<BaseShape> brushes;
    for (const char* brush : {"ball-30", "polar-4x6", "polar-5x8", "rhombic-12", "ball-120"}) {
        brushes.push_back(shapes::embedded(brush));
    }
    Poses poses;
    std::vector<double> candidates;
    std::vector<double> whole;
    for (int i = 0; i < count; ++i) {
        const BaseShape& brush = brushes[i % 4];
        const auto request = outward_request(target.surface, Vertex(poses.below(target.surface.n_vertices())));
        candidates.push_back(milliseconds([&] { (void)extrude_candidates(target.surface, element, brush, request); }));
        whole.push_back(
            milliseconds([&] { (void)extrude(target.surface, element, brush, request, merge_options().embedding); }));
    }
    std::printf(
        "extrude on %s: candidates median %.1f, 95 %% %.1f, most %.1f ms; embedded median %.1f, 95 %% %.1f ms\n",
        name.c_str(), share(candidates, 0.5), share(candidates, 0.95), share(candidates, 1), share(whole, 0.5),
        share(whole, 0.95));
    MergeCounts counts;
    while (counts.poses < count) {
        const BaseShape& brush = brushes[static_cast<std::size_t>(counts.poses) % brushes.size()];
        const Surface moved = overlapping(target.surface, brush.surface, poses);
        if (overlap(target.surface, moved, 0).any) { // a refusal of parts that do not touch takes no time
            count_pose(target.surface, moved, brush.name, counts);
        }
    }
    print("merge with " + name, counts);
    return 0;
}

} // namespace
} // namespace rhombloom

int main(int argc, char** argv)
{
    const auto number = [&](int i, double fallback) { return argc > i ? std::atof(argv[i]) : fallback; };
    const auto integer = [&](int i, int fallback) { return std::max(1, static_cast<int>(number(i, fallback))); };
    const std::string command = argc > 1 ? argv[1] : "";
    if (command == "merge" && argc >= 4) {
        return rhombloom::bench_merge(argv[2], argv[3], integer(4, 200), number(5, 1.4), number(6, 2.4));
    }
    if (command == "pairs") {
        return rhombloom::bench_pairs(integer(2, 200), integer(3, 120));
    }
    if (command == "extrude") {
        return rhombloom::bench_extrude(integer(2, 1));
    }
    if (command == "time") {
        return rhombloom::bench_time(integer(2, 40), argc > 3 ? argv[3] : "checker-588");
    }
    std::fprintf(stderr, "usage: bench_design merge SHAPE SHAPE [POSES NEAREST FARTHEST] | pairs [POSES LARGEST] | "
                         "extrude [EVERY] | time [POSES TARGET]\n");
    return 2;
}
