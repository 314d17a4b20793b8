#include "core/form/inflate.h"

#include <algorithm>

#include "core/form/start_shape.h"

namespace rhombloom {

namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int passes = 300;
constexpr int adjustments = 3;   // of the springs, per pass
constexpr double softness = 0.1; // of a spring that is too short, against one that is too long
constexpr double relaxation = 1.5;
constexpr int film_passes = 200;

// Area vectors at the vertices, pointing outwards, none longer than la^2.
Matrix3Xd area_vectors(const EmbeddingTerms& terms, const Matrix3Xd& x)
{
    Matrix3Xd out = Matrix3Xd::Zero(3, terms.vertex_count);
    for (const HingeVertices& h : terms.hinges) {
        out.col(h[0]) += hinge_normal({x.col(h[0]), x.col(h[1]), x.col(h[2]), x.col(h[3])}) / 4;
    }
    for (int v = 0; v < terms.vertex_count; ++v) {
        out.col(v) /= std::max(1.0, out.col(v).norm());
    }
    return out;
}

// Where the springs at each vertex would have it, on average.
Matrix3Xd adjustment(const EmbeddingTerms& terms, const Matrix3Xd& x)
{
    Matrix3Xd out = Matrix3Xd::Zero(3, terms.vertex_count);
    VectorXd count = VectorXd::Zero(terms.vertex_count);
    for (const SpringPair& pair : terms.springs) {
        const Vector3d d = x.col(pair.b) - x.col(pair.a);
        const double length = std::max(d.norm(), 1e-9);
        const double excess = 1 - (pair.rest[0] + pair.rest[1]) / 2 / length;
        const Vector3d shift = (excess > 0 ? 0.5 : 0.5 * softness) * excess * d;
        out.col(pair.a) += shift;
        out.col(pair.b) -= shift;
        ++count[pair.a];
        ++count[pair.b];
    }
    return relaxation * out * count.cwiseMax(1).cwiseInverse().asDiagonal();
}

} // namespace

void inflate(const EmbeddingTerms& terms, const std::vector<bool>& is_free, double pressure, VectorXd& positions)
{
    Matrix3Xd x = positions.reshaped(3, terms.vertex_count);
    VectorXd mask(terms.vertex_count);
    std::transform(is_free.begin(), is_free.end(), mask.begin(), [](bool moves) { return moves ? 1 : 0; });
    for (int pass = 0; pass < passes; ++pass) {
        x += pressure * (1 - double(pass) / passes) * area_vectors(terms, x) * mask.asDiagonal();
        for (int k = 0; k < adjustments; ++k) {
            x += adjustment(terms, x) * mask.asDiagonal();
        }
    }
    positions = (x.colwise() - x.rowwise().mean()).reshaped();
}

void stretch_film(const EmbeddingTerms& terms, const std::vector<bool>& is_free, VectorXd& x)
{
    const std::vector<std::vector<int>> neighbours = spring_neighbours(terms);
    for (int pass = 0; pass < film_passes; ++pass) {
        for (int v = 0; v < terms.vertex_count; ++v) {
            if (!is_free[v]) {
                continue;
            }
            Vector3d sum = Vector3d::Zero();
            for (const int w : neighbours[v]) {
                sum += x.segment<3>(3 * w);
            }
            x.segment<3>(3 * v) = sum / double(neighbours[v].size());
        }
    }
}

} // namespace rhombloom
