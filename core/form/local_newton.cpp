#include "core/form/local_newton.h"

#include <algorithm>

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr int rings = 3;               // held free around the vertices out of equilibrium
constexpr double largest_share = 0.25; // of all vertices

std::vector<bool> out_of_equilibrium(const Iterate& iterate, double tolerance)
{
    std::vector<bool> marked(iterate.x.size() / 3);
    for (std::size_t v = 0; v < marked.size(); ++v) {
        marked[v] = iterate.gradient.segment<3>(3 * v).lpNorm<Eigen::Infinity>() > tolerance;
    }
    return marked;
}

void add_ring(const EmbeddingTerms& terms, std::vector<bool>& marked)
{
    const std::vector<bool> old = marked;
    for (const SpringPair& pair : terms.springs) {
        if (old[pair.a] || old[pair.b]) {
            marked[pair.a] = marked[pair.b] = true;
        }
    }
}

// The terms that a set of vertices takes part in, with the vertices renumbered: the free ones first.
struct Patch
{
    EmbeddingTerms terms;
    std::vector<int> vertices; // number in the whole
};

class PatchMaker
{
public:
    PatchMaker(const EmbeddingTerms& whole, const std::vector<bool>& is_free)
        : whole_(whole), is_free_(is_free), number_(is_free.size(), -1)
    {
        for (std::size_t v = 0; v < is_free.size(); ++v) {
            if (is_free[v]) {
                number(static_cast<int>(v));
            }
        }
        patch_.terms.free_count = static_cast<int>(patch_.vertices.size());
    }

    Patch make()
    {
        patch_.terms.la = whole_.la;
        patch_.terms.spring_law = whole_.spring_law;
        patch_.terms.hinge_law = whole_.hinge_law;
        for (const SpringPair& pair : whole_.springs) {
            if (is_free_[pair.a] || is_free_[pair.b]) {
                SpringPair& copy = patch_.terms.springs.emplace_back(pair);
                copy.a = number(pair.a);
                copy.b = number(pair.b);
            }
        }
        for (const HingeVertices& hinge : whole_.hinges) {
            if (std::any_of(hinge.begin(), hinge.end(), [&](int v) { return is_free_[v]; })) {
                HingeVertices& copy = patch_.terms.hinges.emplace_back();
                std::transform(hinge.begin(), hinge.end(), copy.begin(), [&](int v) { return number(v); });
            }
        }
        patch_.terms.vertex_count = static_cast<int>(patch_.vertices.size());
        return std::move(patch_);
    }

private:
    int number(int v)
    {
        if (number_[v] < 0) {
            number_[v] = static_cast<int>(patch_.vertices.size());
            patch_.vertices.push_back(v);
        }
        return number_[v];
    }

    const EmbeddingTerms& whole_;
    const std::vector<bool>& is_free_;
    std::vector<int> number_;
    Patch patch_;
};

} // namespace

MinimiseResult newton_on(const std::vector<bool>& is_free, const EmbeddingTerms& terms, Iterate& iterate,
                         const MinimiseOptions& options)
{
    const Patch patch = PatchMaker(terms, is_free).make();
    VectorXd x(3 * patch.vertices.size());
    for (std::size_t k = 0; k < patch.vertices.size(); ++k) {
        x.segment<3>(3 * k) = iterate.x.segment<3>(3 * patch.vertices[k]);
    }
    Iterate local = iterate_at(patch.terms, x);
    MinimiseOptions local_options = options;
    if (options.progress) {
        const double elsewhere = iterate.energy - local.energy;
        local_options.progress = [&options, elsewhere](int iteration, const Iterate& now) {
            Iterate whole = now;
            whole.energy += elsewhere;
            return options.progress(iteration, whole);
        };
    }
    const MinimiseResult result = newton(patch.terms, local, local_options);
    VectorXd moved = iterate.x;
    for (int k = 0; k < patch.terms.free_count; ++k) {
        moved.segment<3>(3 * patch.vertices[k]) = local.x.segment<3>(3 * k);
    }
    iterate = iterate_at(terms, std::move(moved));
    return result;
}

MinimiseResult local_newton(const EmbeddingTerms& terms, Iterate& iterate, const MinimiseOptions& options)
{
    std::vector<bool> marked = out_of_equilibrium(iterate, 100 * options.tolerance);
    const auto share = [&] { return double(std::count(marked.begin(), marked.end(), true)) / double(marked.size()); };
    for (int k = 0; k < rings && share() > 0 && share() < largest_share; ++k) {
        add_ring(terms, marked);
    }
    if (share() == 0 || share() >= largest_share) {
        return {};
    }
    MinimiseOptions finer = options;
    finer.tolerance = options.tolerance / 2;
    MinimiseResult result = newton_on(marked, terms, iterate, finer);
    if (result.reason != StopReason::Cancelled && result.reason != StopReason::IterationLimit) {
        result.reason = iterate.gradient_norm() <= options.tolerance ? StopReason::Converged : StopReason::Stalled;
    }
    return result;
}

} // namespace rhombloom
