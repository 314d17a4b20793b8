#include "core/form/start_shape.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "core/form/graph_laplacian.h"

namespace rhombloom {

namespace {

using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int layout_passes = 60;
constexpr double dimple_angle = -0.5; // radians; beyond, a hinge belongs to the rim of a dimple

Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal_axes(const VectorXd& x)
{
    const Matrix3Xd points = x.reshaped(3, x.size() / 3);
    const Matrix3Xd centred = points.colwise() - points.rowwise().mean();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred * centred.transpose());
}

// Uniform in [-1, 1), the same on every machine.
double random_unit(std::mt19937_64& random)
{
    return double(random() >> 11) * 0x1p-52 - 1;
}

Vector3d mean_normal(const EmbeddingTerms& terms, const VectorXd& x)
{
    Vector3d sum = Vector3d::Zero();
    for (const HingeVertices& h : terms.hinges) {
        sum += hinge_normal(hinge_points(x, h));
    }
    return sum;
}

// Numbers of the parts that remain when the marked vertices are taken out; -1 for these.
std::vector<int> parts_without(const std::vector<std::vector<int>>& neighbours, const std::vector<bool>& removed)
{
    const int n = static_cast<int>(neighbours.size());
    std::vector<int> part(n, -1);
    int count = 0;
    for (int seed = 0; seed < n; ++seed) {
        if (removed[seed] || part[seed] >= 0) {
            continue;
        }
        std::vector<int> stack = {seed};
        part[seed] = count;
        while (!stack.empty()) {
            const int v = stack.back();
            stack.pop_back();
            for (const int w : neighbours[v]) {
                if (!removed[w] && part[w] < 0) {
                    part[w] = count;
                    stack.push_back(w);
                }
            }
        }
        ++count;
    }
    return part;
}

// Reflect the vertices of a part in the plane through the removed vertices next to it.
void reflect(const std::vector<std::vector<int>>& neighbours, const std::vector<int>& part, int which, VectorXd& x)
{
    std::vector<int> rim;
    for (std::size_t v = 0; v < part.size(); ++v) {
        const bool touches = part[v] < 0 && std::any_of(neighbours[v].begin(), neighbours[v].end(),
                                                        [&](int w) { return part[w] == which; });
        if (touches) {
            rim.push_back(static_cast<int>(v));
        }
    }
    if (rim.size() < 3) {
        return;
    }
    VectorXd plane(3 * rim.size());
    for (std::size_t k = 0; k < rim.size(); ++k) {
        plane.segment<3>(3 * k) = x.segment<3>(3 * rim[k]);
    }
    const Vector3d centre = plane.reshaped(3, rim.size()).rowwise().mean();
    const Vector3d normal = principal_axes(plane).eigenvectors().col(0);
    for (std::size_t v = 0; v < part.size(); ++v) {
        if (part[v] == which) {
            x.segment<3>(3 * v) -= 2 * normal.dot(x.segment<3>(3 * v) - centre) * normal;
        }
    }
}

// Proportional to the volume within, negative when inside out.
double volume(const EmbeddingTerms& terms, const VectorXd& x)
{
    double sum = 0;
    for (const HingeVertices& h : terms.hinges) {
        const HingePoints p = hinge_points(x, h);
        sum += p.x0.cross(p.x1).dot(p.x2 - p.x3);
    }
    return sum;
}

// Between all pairs of vertices along springs of rest length, 0 where there is no way.
MatrixXd graph_distances(const EmbeddingTerms& terms)
{
    const int n = terms.vertex_count;
    std::vector<std::vector<std::pair<int, double>>> neighbours(n);
    for (const SpringPair& pair : terms.springs) {
        const double length = (pair.rest[0] + pair.rest[1]) / 2;
        neighbours[pair.a].emplace_back(pair.b, length);
        neighbours[pair.b].emplace_back(pair.a, length);
    }
    MatrixXd distance = MatrixXd::Zero(n, n);
    for (int source = 0; source < n; ++source) {
        using Entry = std::pair<double, int>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        queue.emplace(0, source);
        std::vector<bool> done(n, false);
        while (!queue.empty()) {
            const auto [far, v] = queue.top();
            queue.pop();
            if (done[v]) {
                continue;
            }
            done[v] = true;
            distance(v, source) = far;
            for (const auto& [w, length] : neighbours[v]) {
                queue.emplace(far + length, w);
            }
        }
    }
    return distance;
}

using Layout = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Move each vertex to where the others would have it.
void majorise(const MatrixXd& distance, int passes, Layout& x)
{
    const int n = static_cast<int>(x.cols());
    for (int k = 0; k < passes * n; ++k) {
        const int i = k % n;
        Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
        double weights = 0;
        for (int j = 0; j < n; ++j) {
            if (distance(j, i) > 0) {
                const double weight = 1 / (distance(j, i) * distance(j, i));
                const Eigen::Matrix<double, 6, 1> d = x.col(i) - x.col(j);
                sum += weight * (x.col(j) + d * (distance(j, i) / std::max(d.norm(), 1e-9)));
                weights += weight;
            }
        }
        if (weights > 0) {
            x.col(i) = sum / weights;
        }
    }
}

// From six dimensions to the three in which the vertices spread most.
void squeeze(const MatrixXd& distance, Layout& x)
{
    x.colwise() -= x.rowwise().mean().eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> axes(x * x.transpose());
    x = (axes.eigenvectors().rowwise().reverse().transpose() * x).eval();
    for (int pass = 0; pass < layout_passes; ++pass) {
        x.bottomRows<3>() *= 0.95;
        majorise(distance, 1, x);
    }
    x.bottomRows<3>().setZero();
    majorise(distance, 10, x);
}

} // namespace

std::vector<std::vector<int>> spring_neighbours(const EmbeddingTerms& terms)
{
    std::vector<std::vector<int>> neighbours(terms.vertex_count);
    for (const SpringPair& pair : terms.springs) {
        neighbours[pair.a].push_back(pair.b);
        neighbours[pair.b].push_back(pair.a);
    }
    return neighbours;
}

void rescale(const EmbeddingTerms& terms, VectorXd& x)
{
    double length = 0;
    double rest = 0;
    for (const SpringPair& pair : terms.springs) {
        length += (x.segment<3>(3 * pair.b) - x.segment<3>(3 * pair.a)).norm();
        rest += (pair.rest[0] + pair.rest[1]) / 2;
    }
    if (length > 1e-12 * rest) {
        x *= rest / length;
    }
}

void smooth(const EmbeddingTerms& terms, VectorXd& x, int passes)
{
    const std::vector<std::vector<int>> neighbours = spring_neighbours(terms);
    for (int pass = 0; pass < passes; ++pass) {
        const VectorXd old = x;
        for (int v = 0; v < terms.vertex_count; ++v) {
            Vector3d sum = old.segment<3>(3 * v);
            for (const int w : neighbours[v]) {
                sum += old.segment<3>(3 * w);
            }
            x.segment<3>(3 * v) = sum / (1.0 + double(neighbours[v].size()));
        }
    }
    rescale(terms, x);
}

void mirror(VectorXd& x)
{
    const Vector3d normal = principal_axes(x).eigenvectors().col(0);
    auto points = x.reshaped(3, x.size() / 3);
    points -= (2 * normal * (normal.transpose() * points)).eval();
}

int spread_dimensions(const VectorXd& x)
{
    const Vector3d spread = principal_axes(x).eigenvalues().cwiseMax(0).cwiseSqrt();
    return static_cast<int>((spread.array() > std::max(1e-6 * spread[2], 1e-9)).count());
}

void bulge(const EmbeddingTerms& terms, VectorXd& x)
{
    const auto axes = principal_axes(x);
    Vector3d up = axes.eigenvectors().col(0);
    if (up.dot(mean_normal(terms, x)) < 0) {
        up = -up;
    }
    const Vector3d centre = x.reshaped(3, x.size() / 3).rowwise().mean();
    double reach = 0;
    for (int v = 0; v < terms.vertex_count; ++v) {
        reach = std::max(reach, (x.segment<3>(3 * v) - centre).norm());
    }
    for (int v = 0; v < terms.vertex_count; ++v) {
        const double r = (x.segment<3>(3 * v) - centre).norm() / reach;
        x.segment<3>(3 * v) += 0.3 * reach * (1 - r * r) * up;
    }
}

void separate(const EmbeddingTerms& terms, VectorXd& x)
{
    std::mt19937_64 random(1);
    std::vector<bool> moved(terms.vertex_count, false);
    for (const SpringPair& pair : terms.springs) {
        const double length = (x.segment<3>(3 * pair.b) - x.segment<3>(3 * pair.a)).norm();
        if (length < 1e-3 && !moved[pair.a] && !moved[pair.b]) {
            moved[pair.b] = true;
            x.segment<3>(3 * pair.b) += 0.1 * Vector3d(random_unit(random), random_unit(random), random_unit(random));
        }
    }
}

VectorXd spectral_layout(const EmbeddingTerms& terms)
{
    const int n = terms.vertex_count;
    if (n < 4) {
        return VectorXd::Zero(3 * n);
    }
    const GraphLaplacian laplacian(terms, {});
    std::mt19937_64 random(2);
    MatrixXd modes(n, 4);
    for (double& value : modes.reshaped()) {
        value = random_unit(random);
    }
    modes.col(0).setOnes();
    const auto orthonormal = [&] {
        return (Eigen::HouseholderQR<MatrixXd>(modes).householderQ() * MatrixXd::Identity(n, 4)).eval();
    };
    for (int k = 0; k < 60; ++k) {
        modes = orthonormal();
        modes.rightCols<3>() = laplacian.solve(modes.rightCols<3>());
    }
    modes = orthonormal();
    VectorXd x = modes.rightCols<3>().transpose().reshaped();
    rescale(terms, x);
    VectorXd mirrored = x;
    mirror(mirrored);
    return embedding_energy(terms, mirrored).total() < embedding_energy(terms, x).total() ? mirrored : x;
}

VectorXd distance_layout(const EmbeddingTerms& terms, int variant)
{
    const int n = terms.vertex_count;
    const MatrixXd distance = graph_distances(terms);
    Layout x = Layout::Zero(6, n);
    x.topRows<3>() = spectral_layout(terms).reshaped(3, n);
    std::mt19937_64 random(3 + variant);
    const int dimensions = variant % 2 == 0 ? 6 : 3;
    for (double& value : x.topRows(dimensions).reshaped()) {
        value += random_unit(random);
    }
    majorise(distance, layout_passes, x);
    if (dimensions > 3) {
        squeeze(distance, x);
    }
    VectorXd out = (x.topRows<3>().colwise() - x.topRows<3>().rowwise().mean()).reshaped();
    rescale(terms, out);
    if (volume(terms, out) < 0) {
        mirror(out);
    }
    return out;
}

double sharpest_concavity(const EmbeddingTerms& terms, const VectorXd& x)
{
    double smallest = 0;
    for (const HingeVertices& h : terms.hinges) {
        smallest = std::min(smallest, hinge_angle(hinge_points(x, h)));
    }
    return smallest;
}

bool pop_dimples(const EmbeddingTerms& terms, VectorXd& x)
{
    std::vector<bool> rim(terms.vertex_count, false);
    for (const HingeVertices& h : terms.hinges) {
        if (hinge_angle(hinge_points(x, h)) < dimple_angle) {
            rim[h[0]] = rim[h[1]] = true;
        }
    }
    const std::vector<std::vector<int>> neighbours = spring_neighbours(terms);
    const std::vector<int> part = parts_without(neighbours, rim);
    const int count = 1 + *std::max_element(part.begin(), part.end());
    std::vector<int> size(std::max(1, count), 0);
    for (const int p : part) {
        size[std::max(0, p)] += p >= 0;
    }
    const int outside = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
    for (int p = 0; p < count; ++p) {
        if (p != outside) {
            reflect(neighbours, part, p, x);
        }
    }
    return count > 1;
}

} // namespace rhombloom
