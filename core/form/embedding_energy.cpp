#include "core/form/embedding_energy.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/form/parallel.h"
#include "core/form/term_kernels.h"

namespace rhombloom {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Below this length (in la) the direction of a spring is noise.
constexpr double smallest_length = 1e-12;
constexpr int part_count = 8; // of a large surface's terms; the same for any number of threads, for the same sums

Vector3d point(const VectorXd& x, int v)
{
    return x.segment<3>(3 * v);
}

SpringResponse pair_response(const SpringLaw& law, const SpringPair& pair, double length)
{
    SpringResponse sum;
    for (int k = 0; k < pair.count; ++k) {
        const SpringResponse one = spring_response(law, pair.rest[k], length);
        sum.energy += one.energy;
        sum.barrier += one.barrier;
        sum.force += one.force;
        sum.stiffness += one.stiffness;
    }
    return sum;
}

// Convex by less than a right angle, which costs nothing? Costs little to find out.
bool is_free(const HingeLaw& law, const HingePoints& p)
{
    const Vector3d left = (p.x1 - p.x0).cross(p.x2 - p.x0);
    return law.convex_weight == 0 && left.dot(p.x3 - p.x0) <= 0 && left.dot((p.x3 - p.x0).cross(p.x1 - p.x0)) >= 0;
}

// The response with which the k-th hinge enters the Hessian.
HingeResponse hinge_response(const HingeLaw& law, const HingePoints& points, std::size_t k,
                             const HessianOptions& options)
{
    if (options.hinges == nullptr && is_free(law, points)) {
        return {};
    }
    HingeResponse response =
        options.hinges == nullptr ? hinge_response(law, hinge_angle(points)) : (*options.hinges)[k];
    response.moment *= 1 - options.damping;
    return response;
}

void add_block(BlockMatrix& matrix, int block, const Matrix3d& addend)
{
    if (block >= 0) {
        Eigen::Map<Matrix3d>(&matrix.value[9 * std::size_t(block)]) += addend;
    }
}

void add_spring(const EmbeddingTerms& terms, const SpringPair& pair, const std::array<int, 3>& blocks,
                const VectorXd& x, double damping, BlockMatrix& hessian)
{
    const Vector3d difference = point(x, pair.b) - point(x, pair.a);
    const double length = std::max(difference.norm(), smallest_length);
    const SpringResponse response = pair_response(terms.spring_law, pair, length);
    double lateral = response.force / length;
    if (lateral < 0) {
        lateral *= 1 - damping;
    }
    const Vector3d u = difference / length;
    const Matrix3d block = (response.stiffness - lateral) * u * u.transpose() + lateral * Matrix3d::Identity();
    add_block(hessian, blocks[0], block);
    add_block(hessian, blocks[1], block);
    add_block(hessian, blocks[2], -block);
}

void add_hinge(const HingeResponse& response, const HingeVertices& hinge, const std::array<int, 10>& blocks,
               const HingePoints& points, BlockMatrix& hessian)
{
    if (response.stiffness == 0) {
        return;
    }
    const HingeBlocks terms = hinge_hessian(points, response.stiffness, response.moment);
    for (int k = 0, n = 0; k < 4; ++k) {
        for (int l = 0; l <= k; ++l, ++n) {
            add_block(hessian, blocks[n], hinge[k] >= hinge[l] ? terms[n] : Matrix3d(terms[n].transpose()));
        }
    }
}

EnergyParts evaluate(const EmbeddingTerms& terms, const VectorXd& x, double* gradient)
{
    const TermEnergy springs = term_kernels().springs(terms, x.data(), gradient);
    const TermEnergy hinges = term_kernels().hinges(terms, x.data(), gradient);
    return {springs.energy, hinges.energy, springs.guard + hinges.guard};
}

} // namespace

EnergyParts embedding_energy(const EmbeddingTerms& terms, const VectorXd& x)
{
    return evaluate(terms, x, nullptr);
}

EnergyParts embedding_gradient(const EmbeddingTerms& terms, const VectorXd& x, VectorXd& gradient)
{
    gradient.setZero(x.size());
    const EnergyParts parts = evaluate(terms, x, gradient.data());
    gradient.tail(3 * (terms.vertex_count - terms.free_count)).setZero();
    return parts;
}

BlockMatrix hessian_matrix(const EmbeddingTerms& terms, HessianPattern& pattern)
{
    std::vector<std::pair<int, int>> pairs;
    const auto add_pair = [&](int i, int j) {
        if (i < terms.free_count && j < terms.free_count) {
            pairs.emplace_back(i, j);
        }
    };
    for (const SpringPair& pair : terms.springs) {
        add_pair(pair.a, pair.b);
    }
    for (const HingeVertices& hinge : terms.hinges) {
        add_pair(hinge[2], hinge[3]); // the other pairs are sides and diagonals
    }
    BlockMatrix matrix = make_block_matrix(terms.free_count, std::move(pairs));
    const auto block = [&](int i, int j) {
        return i < terms.free_count && j < terms.free_count ? block_index(matrix, i, j) : -1;
    };
    pattern = {};
    pattern.rest.springs.resize(terms.springs.size());
    pattern.rest.hinges.resize(terms.hinges.size());
    std::iota(pattern.rest.springs.begin(), pattern.rest.springs.end(), 0);
    std::iota(pattern.rest.hinges.begin(), pattern.rest.hinges.end(), 0);
    for (const SpringPair& pair : terms.springs) {
        pattern.spring_blocks.push_back({block(pair.a, pair.a), block(pair.b, pair.b), block(pair.a, pair.b)});
    }
    for (const HingeVertices& hinge : terms.hinges) {
        std::array<int, 10>& blocks = pattern.hinge_blocks.emplace_back();
        for (int k = 0, n = 0; k < 4; ++k) {
            for (int l = 0; l <= k; ++l, ++n) {
                blocks[n] = block(hinge[k], hinge[l]);
            }
        }
    }
    return matrix;
}

void divide_by(const std::vector<int>& order, const EmbeddingTerms& terms, HessianPattern& pattern)
{
    std::vector<int> part_of(terms.vertex_count, -1);
    for (std::size_t k = 0; k < order.size(); ++k) {
        part_of[order[k]] = static_cast<int>(k * part_count / order.size());
    }
    pattern.parts.assign(part_count, {});
    pattern.rest = {};
    const auto home = [&](const auto& vertices) -> HessianPart& {
        const int part = part_of[vertices[0]];
        const bool inside =
            part >= 0 && std::all_of(vertices.begin(), vertices.end(), [&](int v) { return part_of[v] == part; });
        return inside ? pattern.parts[part] : pattern.rest;
    };
    for (std::size_t k = 0; k < terms.springs.size(); ++k) {
        home(std::array{terms.springs[k].a, terms.springs[k].b}).springs.push_back(static_cast<int>(k));
    }
    for (std::size_t k = 0; k < terms.hinges.size(); ++k) {
        home(terms.hinges[k]).hinges.push_back(static_cast<int>(k));
    }
}

void embedding_hessian(const EmbeddingTerms& terms, const HessianPattern& pattern, const VectorXd& x,
                       const HessianOptions& options, BlockMatrix& hessian)
{
    const auto add = [&](const HessianPart& part) {
        for (const int k : part.springs) {
            add_spring(terms, terms.springs[k], pattern.spring_blocks[k], x, options.damping, hessian);
        }
        for (const int k : part.hinges) {
            const HingePoints points = hinge_points(x, terms.hinges[k]);
            add_hinge(hinge_response(terms.hinge_law, points, k, options), terms.hinges[k], pattern.hinge_blocks[k],
                      points, hessian);
        }
    };
    std::fill(hessian.value.begin(), hessian.value.end(), 0.0);
    parallel_tasks(options.threads, static_cast<int>(pattern.parts.size()), [&](int k) { add(pattern.parts[k]); });
    add(pattern.rest);
}

} // namespace rhombloom
