#include "exporters/preview_targets.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;

//! No finer than asked for, coarse enough that the flat target fits into 16 bits.
Grid make_grid(double step_mm, double size_mm, int short_steps)
{
    Grid grid;
    grid.step = step_mm;
    grid.unit = std::max(step_mm, 1.1 * size_mm / 32767);
    grid.turn_decimals = static_cast<int>(std::ceil(std::log10(size_mm / grid.step)));
    grid.short_steps = short_steps;
    return grid;
}

//! Points (mm) and normals of every element with its thickness, in its own frame: one column per element.
struct LocalShapes
{
    Eigen::MatrixXd points;
    Eigen::MatrixXd normals;
};

LocalShapes local_shapes(const PreviewModel& model, const BendingModes& modes)
{
    const int rows = static_cast<int>(6 * model.bent.sheet.points.size());
    const int columns = static_cast<int>(model.bent.elements.size());
    LocalShapes shapes{Eigen::MatrixXd(rows, columns), Eigen::MatrixXd(rows, columns)};
    for (int f = 0; f < columns; ++f) {
        const BentPose& pose = modes.poses[f];
        const SolidElement solid = solid_element(model.bent, model.bent.elements[f], model.thickness);
        for (int i = 0; i < rows / 3; ++i) {
            shapes.points.col(f).segment<3>(3 * i) = pose.axes.transpose() * (solid.points[i] - pose.origin);
            shapes.normals.col(f).segment<3>(3 * i) = pose.axes.transpose() * solid.normals[i];
        }
    }
    return shapes;
}

//! What goes with 1 and with each weight, by least squares over all elements: columns mean, mode 1, mode 2, ...
LocalShapes linear_model(const LocalShapes& shapes, const BendingModes& modes)
{
    Eigen::MatrixXd weights(modes.modes.cols() + 1, shapes.points.cols());
    for (int f = 0; f < weights.cols(); ++f) {
        weights.col(f) << 1, modes.poses[f].weights;
    }
    Eigen::MatrixXd square = weights * weights.transpose();
    square.diagonal().array() += 1e-9 * square.diagonal().maxCoeff();
    const Eigen::LDLT<Eigen::MatrixXd> factor(square);
    return {factor.solve(weights * shapes.points.transpose()).transpose(),
            factor.solve(weights * shapes.normals.transpose()).transpose()};
}

SolidElement mean_shape(const LocalShapes& model)
{
    SolidElement mean;
    for (int i = 0; i < model.points.rows(); i += 3) {
        mean.points.push_back(model.points.col(0).segment<3>(i));
        mean.normals.push_back(model.normals.col(0).segment<3>(i).normalized());
    }
    return mean;
}

//! The flat piece with its thickness, in the frame of the modes.
SolidElement flat_shape(const PreviewModel& model)
{
    const FlatSheet& sheet = model.bent.sheet;
    BentElement flat;
    for (const Vec2& p : sheet.points) {
        flat.points.push_back(Vec3(p.x(), p.y(), 0));
    }
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : flat.points) {
        middle += p / static_cast<double>(flat.points.size());
    }
    for (Vec3& p : flat.points) {
        p -= middle;
    }
    flat.normals.assign(flat.points.size(), Vec3::UnitZ());
    return solid_element(model.bent, flat, model.thickness);
}

Deltas difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double scale)
{
    Deltas d(3, static_cast<int>(a.size()));
    for (std::size_t i = 0; i < a.size(); ++i) {
        d.col(static_cast<int>(i)) = scale * (a[i] - b[i]);
    }
    return d;
}

//! The farthest that any coordinate is from its place in the flat piece, mm.
double flat_reach(const PreviewModel& model, const SolidElement& mean)
{
    return difference(flat_shape(model).points, mean.points, 1).cwiseAbs().maxCoeff();
}

double largest_weight(const BendingModes& modes, int k)
{
    double largest = 1e-9;
    for (const BentPose& pose : modes.poses) {
        largest = std::max(largest, std::abs(pose.weights(k)));
    }
    return largest;
}

//! Mode \p k as a target without normals.
MorphTarget mode_target(const BendingModes& modes, const LocalShapes& model, int k, const Grid& grid)
{
    const double largest = largest_weight(modes, k);
    const Eigen::VectorXd points = largest * model.points.col(k + 1);
    const Eigen::Map<const Deltas> moves(points.data(), 3, points.size() / 3);
    const double steps = std::max(1.0, std::ceil(std::sqrt(moves.colwise().squaredNorm().maxCoeff()) / grid.step));
    MorphTarget target;
    target.per_weight = steps / largest;
    target.one_byte = steps <= grid.short_steps;
    target.scale = 1.0 / (target.one_byte ? 127 : 32767);
    if (modes.grain.size() > 0 && modes.grain(k) > 0) {
        target.one_byte = true;
        target.scale = 1.0 / 127;
        target.per_weight = modes.grain(k) / (target.scale * grid.unit);
    }
    target.points = (moves / (target.per_weight * largest * grid.unit * target.scale)).array().round();
    return target;
}

//! \brief Give targets their normals, those that turn most first, until the rest is worth less than a few degrees.
//! \details A mode's normals cost as much as its points, and only shading needs them.
void add_normals(const BendingModes& modes, const LocalShapes& model, std::vector<MorphTarget>& targets)
{
    constexpr double enough = 0.1; // root mean square of all normals' changes that are left out
    constexpr int most = 6;
    const int count = static_cast<int>(targets.size());
    std::vector<double> turning(count, 0);
    for (int k = 0; k < count; ++k) {
        for (const BentPose& pose : modes.poses) {
            turning[k] += std::pow(pose.weights(k), 2) / static_cast<double>(modes.poses.size());
        }
        turning[k] *= model.normals.col(k + 1).squaredNorm() / (static_cast<double>(model.normals.rows()) / 3);
    }
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return turning[a] > turning[b]; });
    double rest = std::accumulate(turning.begin(), turning.end(), 0.0);
    for (int i = 0; i < std::min(count, most) && rest > enough * enough; ++i) {
        const int k = order[i];
        const Eigen::VectorXd turns = model.normals.col(k + 1) / targets[k].per_weight;
        targets[k].normals = Eigen::Map<const Deltas>(turns.data(), 3, turns.size() / 3);
        rest -= turning[k];
    }
}

//! The last target: weight 1 lays the element flat.
MorphTarget flat_target(const PreviewModel& model, const SolidElement& mean, const Grid& grid)
{
    const SolidElement flat = flat_shape(model);
    MorphTarget target;
    target.points = (difference(flat.points, mean.points, 1 / grid.unit)).array().round();
    target.normals = difference(flat.normals, mean.normals, 1);
    return target;
}

template <class Integer>
void append(std::string& bytes, const Deltas& values, const std::vector<std::uint16_t>& order, double scale)
{
    for (const std::uint16_t v : order) {
        std::array<Integer, 4> cell{}; // padded to a multiple of four bytes
        for (int k = 0; k < 3; ++k) {
            cell[k] = static_cast<Integer>(std::lround(values(k, v) * scale));
        }
        bytes.append(reinterpret_cast<const char*>(cell.data()), sizeof cell);
    }
}

Json bounds_of(const Deltas& values, bool low)
{
    const Vec3 b = low ? Vec3(values.rowwise().minCoeff()) : Vec3(values.rowwise().maxCoeff());
    return {short_number(b.x()), short_number(b.y()), short_number(b.z())};
}

//! Buffers of the same stride that several accessors share.
struct SharedView
{
    std::string bytes;
    int stride = 4;
    std::vector<int> accessors;
};

void finish(Glb& glb, const SharedView& shared)
{
    if (shared.bytes.empty()) {
        return;
    }
    const int view = add_view(glb, shared.bytes, ViewTarget::Vertices, shared.stride);
    for (const int accessor : shared.accessors) {
        Json a{{"bufferView", view}}; // first, as everywhere
        a.update(glb.json["accessors"][accessor]);
        glb.json["accessors"][accessor] = std::move(a);
    }
}

int shared_accessor(Glb& glb, SharedView& shared, Component component, std::size_t count)
{
    const int accessor = add_accessor(glb, -1, component, "VEC3", count);
    if (!shared.bytes.empty()) {
        glb.json["accessors"][accessor]["byteOffset"] = shared.bytes.size();
    }
    shared.accessors.push_back(accessor);
    return accessor;
}

int add_points(Glb& glb, SharedView& view, const MorphTarget& t, const std::vector<std::uint16_t>& order)
{
    const int points = shared_accessor(glb, view, t.one_byte ? Component::Int8 : Component::Int16, order.size());
    if (t.scale != 1) {
        glb.json["accessors"][points]["normalized"] = true;
    }
    glb.json["accessors"][points]["min"] = bounds_of(t.points, true);
    glb.json["accessors"][points]["max"] = bounds_of(t.points, false);
    t.one_byte ? append<std::int8_t>(view.bytes, t.points, order, 1)
               : append<std::int16_t>(view.bytes, t.points, order, 1);
    return points;
}

//! Eight bits are enough for the flat target, whose weight is at most 1.
int add_normals(Glb& glb, SharedView& view, const Deltas& turns, const std::vector<std::uint16_t>& order)
{
    const bool one_byte = view.stride == 4;
    const int normals = shared_accessor(glb, view, one_byte ? Component::Int8 : Component::Int16, order.size());
    glb.json["accessors"][normals]["normalized"] = true;
    const Deltas clipped = turns.cwiseMin(1).cwiseMax(-1);
    one_byte ? append<std::int8_t>(view.bytes, clipped, order, 127)
             : append<std::int16_t>(view.bytes, clipped, order, 32767);
    return normals;
}

} // namespace

nlohmann::ordered_json short_number(double value)
{
    const auto whole = static_cast<long long>(value);
    return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

MorphedElement morphed_element(const PreviewModel& model, double step_mm, int short_steps)
{
    const BendingModes& modes = model.modes;
    const LocalShapes shapes = linear_model(local_shapes(model, modes), modes);
    MorphedElement result{{}, mean_shape(shapes), {}};
    result.grid = make_grid(step_mm, flat_reach(model, result.mean), short_steps);
    for (int k = 0; k < modes.modes.cols(); ++k) {
        result.targets.push_back(mode_target(modes, shapes, k, result.grid));
    }
    add_normals(modes, shapes, result.targets);
    result.targets.push_back(flat_target(model, result.mean, result.grid));
    return result;
}

nlohmann::ordered_json add_targets(Glb& glb, const std::vector<MorphTarget>& targets,
                                   const std::vector<std::uint16_t>& order)
{
    SharedView small{{}, 4, {}};
    SharedView large{{}, 8, {}};
    int zero = -1;
    Json list = Json::array();
    for (const MorphTarget& t : targets) {
        const int points = add_points(glb, t.one_byte ? small : large, t, order);
        int normals = -1;
        if (t.normals.size() > 0) {
            normals = add_normals(glb, t.normals.cwiseAbs().maxCoeff() > 0.5 ? small : large, t.normals, order);
        } else {
            zero = zero >= 0 ? zero : add_accessor(glb, -1, Component::Float, "VEC3", order.size());
            normals = zero;
        }
        list.push_back({{"POSITION", points}, {"NORMAL", normals}});
    }
    finish(glb, large);
    finish(glb, small);
    return list;
}

} // namespace rhombloom
