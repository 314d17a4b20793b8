#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "exporters/bending_modes.h"
#include "exporters/bent_element_solid.h"
#include "exporters/draco_mesh.h"
#include "exporters/preview_model.h"

// One element with morph targets. Everything below a group node is in units of a few micrometres, z up, in the
// elements' own frames: the targets are then small integers. Elements that are turned over hang under a mirrored group.

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;
using Deltas = Eigen::Matrix3Xd; //!< one column per point

constexpr int normal_bits = 8;

//! \brief How finely numbers are written.
struct Grid
{
    double unit = 1e-3;    //!< mm per unit below the groups
    double step = 5e-3;    //!< mm, of positions and of what a weight's last digit moves
    int turn_decimals = 4; //!< of quaternions
};

//! Fine enough for the tolerance, coarse enough that the flat target fits into 16 bits.
Grid make_grid(double tolerance_mm, double size_mm)
{
    Grid grid;
    grid.step = 0.15 * tolerance_mm;
    grid.unit = std::max(grid.step / 8, 1.1 * size_mm / 32767);
    grid.turn_decimals = static_cast<int>(std::ceil(std::log10(size_mm / grid.step)));
    return grid;
}

double rounded(double value, int decimals)
{
    const double scale = std::pow(10.0, decimals);
    return std::round(value * scale) / scale;
}

Json number(double value)
{
    // Whole numbers without ".0": the node list is most of the file.
    const auto whole = static_cast<long long>(value);
    return static_cast<double>(whole) == value ? Json(whole) : Json(value);
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

//! A morph target: what is added to points (units) and normals for weight 1, and how weights are rounded.
struct Target
{
    Deltas points;
    Deltas normals;        //!< empty: none worth storing
    double per_weight = 1; //!< weight of the file per weight of the mode
    int decimals = 0;
};

//! Mode \p k as a target. The file's weights are at most about 10, in steps that move no point by more than the grid's.
Target mode_target(const BendingModes& modes, const LocalShapes& model, int k, const Grid& grid)
{
    double largest = 1e-9;
    for (const BentPose& pose : modes.poses) {
        largest = std::max(largest, std::abs(pose.weights(k)));
    }
    const Eigen::VectorXd points = largest * model.points.col(k + 1);
    const Eigen::VectorXd normals = largest * model.normals.col(k + 1);
    const Eigen::Map<const Deltas> moves(points.data(), 3, points.size() / 3);
    const Eigen::Map<const Deltas> turns(normals.data(), 3, normals.size() / 3);
    const double steps = std::max(1.0, std::ceil(std::sqrt(moves.colwise().squaredNorm().maxCoeff()) / grid.step));
    const double top = std::min(steps, 10.0); // the file's weight where the mode's is `largest`
    Target target;
    target.per_weight = top / largest;
    target.decimals = steps > top ? static_cast<int>(std::ceil(std::log10(steps / top))) : 0;
    target.points = (moves / (top * grid.unit)).array().round();
    if (turns.cwiseAbs().maxCoeff() > 0.12) {
        target.normals = turns / top;
    }
    return target;
}

//! The last target: weight 1 lays the element flat.
Target flat_target(const PreviewModel& model, const SolidElement& mean, const Grid& grid)
{
    const SolidElement flat = flat_shape(model);
    Target target;
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
    return {number(b.x()), number(b.y()), number(b.z())};
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

//! All targets in the order of the decoded points.
Json add_targets(Glb& glb, const std::vector<Target>& targets, const std::vector<std::uint16_t>& order)
{
    SharedView small{{}, 4, {}};
    SharedView large{{}, 8, {}};
    int zero = -1;
    Json list = Json::array();
    for (const Target& t : targets) {
        const bool fits = t.points.cwiseAbs().maxCoeff() <= 127;
        SharedView& view = fits ? small : large;
        const int points = shared_accessor(glb, view, fits ? Component::Int8 : Component::Int16, order.size());
        glb.json["accessors"][points]["min"] = bounds_of(t.points, true);
        glb.json["accessors"][points]["max"] = bounds_of(t.points, false);
        fits ? append<std::int8_t>(view.bytes, t.points, order, 1)
             : append<std::int16_t>(view.bytes, t.points, order, 1);
        int normals = -1;
        if (t.normals.size() > 0) {
            const bool coarse = t.normals.cwiseAbs().maxCoeff() > 0.5; // the flat target: used with weight 0 to 1
            SharedView& normal_view = coarse ? small : large;
            normals = shared_accessor(glb, normal_view, coarse ? Component::Int8 : Component::Int16, order.size());
            glb.json["accessors"][normals]["normalized"] = true;
            const Deltas clipped = t.normals.cwiseMin(1).cwiseMax(-1);
            coarse ? append<std::int8_t>(normal_view.bytes, clipped, order, 127)
                   : append<std::int16_t>(normal_view.bytes, clipped, order, 32767);
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

struct Placed
{
    Eigen::Quaterniond rotation;
    Vec3 translation;        //!< units
    Eigen::VectorXd weights; //!< as written
};

//! What the file says about element \p f: pose and weights, rounded. The mirrored group negates z.
Placed placed(const BendingModes& modes, const std::vector<Target>& targets, Outward outward, std::size_t f,
              const Grid& grid)
{
    const BentPose& pose = modes.poses[f];
    const Vec3 mirror(1, 1, sign(outward));
    const Eigen::Matrix3d turn = mirror.asDiagonal() * pose.axes;
    Placed p;
    p.rotation = Eigen::Quaterniond(turn);
    if (p.rotation.w() < 0) {
        p.rotation.coeffs() *= -1;
    }
    for (int k = 0; k < 4; ++k) {
        p.rotation.coeffs()(k) = rounded(p.rotation.coeffs()(k), grid.turn_decimals);
    }
    p.translation = (mirror.cwiseProduct(pose.origin) / grid.unit).array().round();
    p.weights.resize(modes.modes.cols());
    for (int k = 0; k < p.weights.size(); ++k) {
        p.weights(k) = rounded(pose.weights(k) * targets[k].per_weight, targets[k].decimals);
    }
    return p;
}

Json node(const PreviewModel& model, const Placed& p, std::size_t f, int mesh)
{
    const Eigen::Vector4d q = p.rotation.coeffs();
    Json weights = Json::array();
    for (const double w : p.weights) {
        weights.push_back(number(w));
    }
    weights.push_back(0);
    return {{"name", model.labels[f].name},
            {"mesh", mesh},
            {"translation", {number(p.translation.x()), number(p.translation.y()), number(p.translation.z())}},
            {"rotation", {number(q(0)), number(q(1)), number(q(2)), number(q(3))}},
            {"weights", std::move(weights)},
            {"extras", {{"step", model.labels[f].step}}}};
}

//! The largest distance of any point, decoded and put together as a viewer does it, from where it belongs.
double decoded_error(const PreviewModel& model, const std::vector<Target>& targets, const std::vector<Placed>& all,
                     const DracoMesh& base, double unit)
{
    double worst = 0;
    for (std::size_t f = 0; f < all.size(); ++f) {
        const BentElement& e = model.bent.elements[f];
        const SolidElement truth = solid_element(model.bent, e, model.thickness);
        const Vec3 mirror(1, 1, sign(e.outward));
        const Eigen::Matrix3d turn = all[f].rotation.normalized().toRotationMatrix();
        for (std::size_t i = 0; i < base.points.size(); ++i) {
            Vec3 p = base.points[i].cast<double>();
            for (int k = 0; k < all[f].weights.size(); ++k) {
                p += all[f].weights(k) * targets[k].points.col(base.order[i]);
            }
            const Vec3 seen = unit * mirror.cwiseProduct(turn * p + all[f].translation);
            worst = std::max(worst, (seen - truth.points[base.order[i]]).norm());
        }
    }
    return worst;
}

Expected<DracoStream> compressed_base(const PreviewModel& model, const SolidElement& mean, const Grid& grid)
{
    DracoMesh mesh;
    for (std::size_t i = 0; i < mean.points.size(); ++i) {
        mesh.points.push_back((mean.points[i] / grid.unit).cast<float>());
        mesh.normals.push_back(mean.normals[i].cast<float>());
        mesh.order.push_back(static_cast<std::uint16_t>(i));
    }
    mesh.triangles = solid_triangles(model.bent.sheet, Outward::Front);
    return compress(mesh, quantisation_bits(extent(mesh.points), grid.step / grid.unit), normal_bits);
}

Json group(const std::string& name, Outward outward, const std::string& component, double unit)
{
    // z up to y up and units to metres; the mirrored group negates z first.
    const double s = 1e-3 * unit;
    const double m = sign(outward) * s;
    return {{"name", name},
            {"matrix", {s, 0, 0, 0, 0, 0, -s, 0, 0, m, 0, 0, 0, 0, 0, 1}},
            {"extras", {{"side", outward == Outward::Front ? "front" : "back"}, {"component", component}}},
            {"children", Json::array()}};
}

void add_nodes(Glb& glb, const PreviewModel& model, const std::vector<Placed>& all, double unit)
{
    std::vector<std::array<int, 2>> groups(model.components.size(), {-1, -1});
    for (std::size_t f = 0; f < all.size(); ++f) {
        const Outward outward = model.bent.elements[f].outward;
        const int component = model.labels[f].component;
        int& g = groups[component][outward == Outward::Back ? 1 : 0];
        if (g < 0) {
            const std::string& name = model.components[component];
            g = static_cast<int>(glb.json["nodes"].size());
            glb.json["nodes"].push_back(
                group(name + (outward == Outward::Back ? " flipped" : " front"), outward, name, unit));
            glb.json["scenes"][0]["nodes"].push_back(g);
        }
    }
    const bool fronts = std::any_of(groups.begin(), groups.end(), [](const auto& g) { return g[0] >= 0; });
    for (std::size_t f = 0; f < all.size(); ++f) {
        const bool back = model.bent.elements[f].outward == Outward::Back;
        const int g = groups[model.labels[f].component][back ? 1 : 0];
        glb.json["nodes"][g]["children"].push_back(glb.json["nodes"].size());
        glb.json["nodes"].push_back(node(model, all[f], f, back && fronts ? 1 : 0));
    }
}

//! The mesh once per side that occurs: the same accessors with another material.
void add_meshes(Glb& glb, const PreviewModel& model, const Json& primitive, std::size_t target_count)
{
    for (const Outward outward : {Outward::Front, Outward::Back}) {
        const bool used = std::any_of(model.bent.elements.begin(), model.bent.elements.end(),
                                      [&](const BentElement& e) { return e.outward == outward; });
        if (used) {
            Json p = primitive;
            p["material"] = outward == Outward::Back ? 1 : 0;
            Json names = Json::array();
            for (std::size_t k = 0; k + 1 < target_count; ++k) {
                names.push_back("bend " + std::to_string(k + 1));
            }
            names.push_back("flat");
            glb.json["meshes"].push_back({{"primitives", Json::array({std::move(p)})},
                                          {"weights", std::vector<int>(target_count, 0)},
                                          {"extras", {{"targetNames", std::move(names)}}}});
        }
    }
}

CompressedPreview write(const PreviewModel& model, const PreviewOptions& options, const DracoStream& base,
                        const std::vector<Target>& targets, const std::vector<Placed>& all, const Grid& grid)
{
    Glb glb = make_glb(model.title);
    glb.json["extensionsUsed"] = {"KHR_draco_mesh_compression", "KHR_mesh_quantization"};
    glb.json["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_mesh_quantization"};
    add_materials(glb, options.lamp == LampLook::On);
    const DracoMesh& mesh = base.decoded;
    const int view = add_view(glb, base.bytes, ViewTarget::None);
    const int points = add_accessor(glb, -1, Component::Float, "VEC3", mesh.points.size());
    set_bounds(glb, points, mesh.points);
    const int normals = add_accessor(glb, -1, Component::Float, "VEC3", mesh.normals.size());
    const int indices = add_accessor(glb, -1, Component::UInt16, "SCALAR", 3 * mesh.triangles.size());
    Json primitive{{"attributes", {{"POSITION", points}, {"NORMAL", normals}}}, {"indices", indices}};
    primitive["targets"] = add_targets(glb, targets, mesh.order);
    primitive["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", base.point_id}, {"NORMAL", base.normal_id}}}};
    add_meshes(glb, model, primitive, targets.size());
    add_nodes(glb, model, all, grid.unit);
    return {glb_bytes(glb), decoded_error(model, targets, all, mesh, grid.unit), static_cast<int>(targets.size()) - 1};
}

} // namespace

Expected<CompressedPreview> modes_glb(const PreviewModel& model, const PreviewOptions& options)
{
    const BendingModes& modes = model.modes;
    const LocalShapes shapes = linear_model(local_shapes(model, modes), modes);
    const SolidElement mean = mean_shape(shapes);
    const Grid grid = make_grid(options.tolerance_mm, flat_reach(model, mean));
    const Expected<DracoStream> base = compressed_base(model, mean, grid);
    if (!base) {
        return tl::make_unexpected(base.error());
    }
    std::vector<Target> targets;
    for (int k = 0; k < modes.modes.cols(); ++k) {
        targets.push_back(mode_target(modes, shapes, k, grid));
    }
    targets.push_back(flat_target(model, mean, grid));
    std::vector<Placed> all;
    for (std::size_t f = 0; f < modes.poses.size(); ++f) {
        all.push_back(placed(modes, targets, model.bent.elements[f].outward, f, grid));
    }
    return write(model, options, *base, targets, all, grid);
}

} // namespace rhombloom
