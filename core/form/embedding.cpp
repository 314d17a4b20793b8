#include "core/form/embedding.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/form/embedding_energy.h"
#include "core/form/parallel.h"
#include "core/form/rigid_alignment.h"
#include "core/form/settle.h"
#include "core/text.h"

namespace rhombloom {

namespace {

using Eigen::VectorXd;

constexpr std::size_t smallest_parallel_surface = 1000; // elements; below, starting threads costs more than it brings

Eigen::Matrix3Xd positions(const Surface& surface)
{
    Eigen::Matrix3Xd points(3, surface.n_vertices());
    for (const Vertex v : surface.vertices()) {
        points.col(v.idx()) = surface.point(v);
    }
    return points;
}

// Centred, in units of la: far from the origin the differences would lose digits.
VectorXd unknowns(const Eigen::Matrix3Xd& points, double la)
{
    const Eigen::Vector3d centre = points.rowwise().mean();
    return ((points.colwise() - centre) / la).reshaped();
}

double max_stretch(const EmbeddingTerms& terms, const VectorXd& x)
{
    double largest = -1;
    for (const SpringPair& pair : terms.springs) {
        const double length = (x.segment<3>(3 * pair.b) - x.segment<3>(3 * pair.a)).norm();
        for (int k = 0; k < pair.count; ++k) {
            largest = std::max(largest, length / pair.rest[k] - 1);
        }
    }
    return largest;
}

EmbedReport report_at(const EmbeddingTerms& terms, const EmbedOptions& options, const VectorXd& x)
{
    VectorXd gradient;
    const EnergyParts parts = embedding_gradient(terms, x, gradient);
    EmbedReport report;
    report.spring_energy = parts.spring * terms.la;
    report.concavity_energy = parts.concavity * terms.la;
    report.energy = report.spring_energy + report.concavity_energy;
    report.guard_energy = parts.guard * terms.la;
    report.concavity_weight = options.concavity_weight;
    report.convex_weight = options.convex_weight;
    report.gradient_norm = gradient.lpNorm<Eigen::Infinity>();
    report.max_stretch = max_stretch(terms, x);
    report.converged = report.gradient_norm <= options.tolerance;
    return report;
}

// A vertex that no computation could start from, as a sentence; empty when there is none.
std::string bad_position(const Surface& surface)
{
    constexpr double largest = 1e9; // mm
    for (const Vertex v : surface.vertices()) {
        const Vec3& p = surface.point(v);
        if (!p.allFinite() || p.cwiseAbs().maxCoeff() > largest) {
            return "vertex " + std::to_string(v.idx()) + " is at (" + to_text(p.x()) + ", " + to_text(p.y()) + ", " +
                   to_text(p.z()) + ") mm: expected finite coordinates of at most " + to_text(largest) + " mm";
        }
    }
    return {};
}

EmbedReport refusal(const EmbedOptions& options, std::string message)
{
    EmbedReport report;
    report.concavity_weight = options.concavity_weight;
    report.convex_weight = options.convex_weight;
    report.message = std::move(message);
    return report;
}

std::string remark(const Settled& settled)
{
    const std::string iterations = std::to_string(settled.result.iterations) + " iterations";
    switch (settled.result.reason) {
    case StopReason::Cancelled:
        return "stopped after " + iterations + " as asked, not in equilibrium";
    case StopReason::IterationLimit:
        return "not in equilibrium after " + iterations;
    case StopReason::Stalled:
        return "no equilibrium found: no further decrease after " + iterations;
    case StopReason::Converged:
        break;
    }
    return settled.guarded ? "elements collapse: the shape is in equilibrium only with the barrier against it" : "";
}

MinimiseOptions minimise_options(const EmbedOptions& options, double la, std::size_t elements)
{
    const bool is_small = elements < smallest_parallel_surface;
    using Clock = std::chrono::steady_clock;
    MinimiseOptions out;
    out.tolerance = options.tolerance;
    out.max_iterations = options.max_iterations;
    out.max_newton_iterations = options.max_newton_iterations;
    out.threads = options.threads > 0 ? options.threads : is_small ? 1 : default_threads();
    const auto begin = Clock::now();
    out.progress = [&options, begin, la, iteration = 0, go_on = true](int, const Iterate& iterate) mutable {
        const std::chrono::duration<double> spent = Clock::now() - begin;
        go_on = go_on && !(options.time_budget_s > 0 && spent.count() > options.time_budget_s);
        if (go_on && options.progress) {
            go_on = options.progress({iteration++, iterate.energy * la, iterate.gradient_norm()});
        }
        return go_on;
    };
    return out;
}

} // namespace

EmbedReport embed(Surface& surface, const Element& element, const EmbedOptions& options)
{
    if (std::string problem = bad_position(surface); !problem.empty()) {
        return refusal(options, std::move(problem));
    }
    EmbeddingTerms terms = embedding_terms(surface, element, options);
    const Eigen::Matrix3Xd start = positions(surface);
    VectorXd x = unknowns(start, element.la);
    const Settled settled =
        settle(terms, x, minimise_options(options, element.la, surface.n_faces()), options.start, options.keep_guards);
    Eigen::Matrix3Xd points = element.la * x.reshaped(3, surface.n_vertices());
    align_rigidly(points, start);
    for (const Vertex v : surface.vertices()) {
        surface.set_point(v, points.col(v.idx()));
    }
    EmbedReport report = report_at(terms, options, x);
    report.iterations = settled.result.iterations;
    report.converged = settled.result.reason == StopReason::Converged;
    report.message = remark(settled);
    return report;
}

EmbedReport measure(const Surface& surface, const Element& element, const EmbedOptions& options)
{
    if (std::string problem = bad_position(surface); !problem.empty()) {
        return refusal(options, std::move(problem));
    }
    const EmbeddingTerms guarded = embedding_terms(surface, element, options);
    EmbeddingTerms pure = guarded;
    remove_guards(pure);
    const VectorXd x = unknowns(positions(surface), element.la);
    const EmbedReport with = report_at(guarded, options, x);
    const EmbedReport without = report_at(pure, options, x);
    return with.gradient_norm < without.gradient_norm ? with : without;
}

} // namespace rhombloom
