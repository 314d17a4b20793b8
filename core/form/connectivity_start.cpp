#include "core/form/connectivity_start.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/form/inflate.h"
#include "core/form/start_shape.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr int most_layouts = 8;
constexpr double layout_work = 2.5e6;                          // squared vertices: about a second each
constexpr std::array<double, 3> pressures = {0.05, 0.15, 0.4}; // small ones keep more of the layout
constexpr std::array<int, 4> widths = {1, 2, 3, 4};            // rings of neighbours around a fold
constexpr double promising = 2;                                // times the lowest energy
constexpr double fold_angle = 2.4;                             // radians, convex
constexpr double same_energy = 1e-6;                           // relative

int layouts(const EmbeddingTerms& terms)
{
    return static_cast<int>(std::min(double(most_layouts), layout_work / terms.vertex_count / terms.vertex_count));
}

std::vector<bool> folded_vertices(const EmbeddingTerms& terms, const VectorXd& x)
{
    std::vector<bool> out(terms.vertex_count, false);
    for (const HingeVertices& h : terms.hinges) {
        const double angle = hinge_angle(hinge_points(x, h));
        if (angle < dimple_angle || angle > fold_angle) {
            out[h[0]] = out[h[1]] = true;
        }
    }
    return out;
}

void add_rings(const EmbeddingTerms& terms, int rings, std::vector<bool>& marked)
{
    for (int k = 0; k < rings; ++k) {
        const std::vector<bool> old = marked;
        for (const SpringPair& pair : terms.springs) {
            if (old[pair.a] || old[pair.b]) {
                marked[pair.a] = marked[pair.b] = true;
            }
        }
    }
}

bool is_cancelled(const Attempt& attempt)
{
    return attempt.result.reason == StopReason::Cancelled;
}

// One layout, blown up with several pressures.
Attempt best_inflated(const EmbeddingTerms& terms, int variant, const MinimiseOptions& options)
{
    const VectorXd layout = distance_layout(terms, variant);
    const std::vector<bool> everywhere(terms.vertex_count, true);
    Attempt best{iterate_at(terms, layout), {}};
    for (const double pressure : pressures) {
        VectorXd x = layout;
        inflate(terms, everywhere, pressure, x);
        Attempt next = attempt(terms, x, options);
        const bool cancelled = is_cancelled(next);
        keep_better(best, std::move(next));
        if (cancelled) {
            best.result.reason = StopReason::Cancelled;
            break;
        }
    }
    return best;
}

// With the region of the folds blown up anew.
Attempt refilled(const EmbeddingTerms& terms, const VectorXd& x, int width, double pressure,
                 const MinimiseOptions& options)
{
    std::vector<bool> region = folded_vertices(terms, x);
    add_rings(terms, width, region);
    VectorXd fresh = x;
    stretch_film(terms, region, fresh);
    inflate(terms, region, pressure, fresh);
    return attempt(terms, fresh, options);
}

// One width after the other; false when none is better, or when cancelled.
bool refill_once(const EmbeddingTerms& terms, Attempt& best, const MinimiseOptions& options)
{
    for (const int width : widths) {
        for (const double pressure : {0.4, 0.15}) {
            Attempt next = refilled(terms, best.iterate.x, width, pressure, options);
            if (is_cancelled(next)) {
                return false;
            }
            if (keep_better(best, std::move(next))) {
                return true;
            }
        }
    }
    return false;
}

// As it is or scaled, whichever costs least: the edges of a shape in equilibrium are a little short on average.
Iterate best_scaled(const EmbeddingTerms& terms, const VectorXd& x)
{
    VectorXd scaled = x;
    rescale(terms, scaled);
    Iterate best = iterate_at(terms, x);
    for (const double scale : {1.0, 0.96, 0.92, 0.88}) {
        Iterate next = iterate_at(terms, scale * scaled);
        best = next.energy < best.energy ? std::move(next) : std::move(best);
    }
    return best;
}

} // namespace

bool knows_nothing(const EmbeddingTerms& terms, const VectorXd& x)
{
    double near = 0;
    for (const SpringPair& pair : terms.springs) {
        near += (x.segment<3>(3 * pair.a) - x.segment<3>(3 * pair.b)).squaredNorm() / double(terms.springs.size());
    }
    const auto points = x.reshaped(3, terms.vertex_count);
    const double any = 2 * (points.colwise() - points.rowwise().mean()).squaredNorm() / terms.vertex_count;
    return near > 0.7 * any;
}

bool is_disordered(const EmbeddingTerms& terms, const VectorXd& x)
{
    const Iterate iterate = best_scaled(terms, x);
    int strained = 0;
    for (int v = 0; v < terms.vertex_count; ++v) {
        strained += iterate.gradient.segment<3>(3 * v).norm() > 1;
    }
    return strained > 0.9 * terms.vertex_count && iterate.energy > 0.1 * double(terms.springs.size());
}

bool has_layouts(const EmbeddingTerms& terms)
{
    return layouts(terms) > 0;
}

Attempt attempt_from_connectivity(const EmbeddingTerms& terms, const MinimiseOptions& options)
{
    Attempt best = best_inflated(terms, 0, options);
    bool found_twice = false;
    for (int k = 0; !is_cancelled(best) && !found_twice && k < layouts(terms); ++k) {
        Attempt next = k == 0 ? best : best_inflated(terms, k, options);
        if (next.iterate.energy < promising * best.iterate.energy) {
            refill_folds(terms, next, options);
        }
        const double difference = std::abs(next.iterate.energy - best.iterate.energy);
        found_twice = k > 0 && is_good(terms, next) && difference < same_energy * best.iterate.energy;
        keep_better(best, std::move(next));
    }
    return best;
}

void refill_folds(const EmbeddingTerms& terms, Attempt& best, const MinimiseOptions& options)
{
    while (!is_cancelled(best) && !is_good(terms, best) && refill_once(terms, best, options)) {
    }
}

} // namespace rhombloom
