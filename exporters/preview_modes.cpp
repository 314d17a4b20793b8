#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "exporters/draco_mesh.h"
#include "exporters/preview_targets.h"

// One element with morph targets. Everything below a group node is in units of a few micrometres, z up, in the
// elements' own frames: the targets are then small integers. Elements that are turned over hang under a mirrored group.

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;

constexpr int normal_bits = 8;

double rounded(double value, int decimals)
{
    const double scale = std::pow(10.0, decimals);
    return std::round(value * scale) / scale;
}

struct Placed
{
    Eigen::Quaterniond rotation;
    Vec3 translation;        //!< units
    Eigen::VectorXd weights; //!< as written
};

//! What the file says about element \p f: pose and weights, rounded. The mirrored group negates z.
Placed placed(const BendingModes& modes, const std::vector<MorphTarget>& targets, Outward outward, std::size_t f,
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
        p.weights(k) = std::round(pose.weights(k) * targets[k].per_weight);
    }
    return p;
}

Json node(const PreviewModel& model, const Placed& p, std::size_t f, int mesh)
{
    const Eigen::Vector4d q = p.rotation.coeffs();
    Json weights = Json::array();
    for (const double w : p.weights) {
        weights.push_back(short_number(w));
    }
    weights.push_back(0);
    return {{"name", model.labels[f].name},
            {"mesh", mesh},
            {"translation",
             {short_number(p.translation.x()), short_number(p.translation.y()), short_number(p.translation.z())}},
            {"rotation", {short_number(q(0)), short_number(q(1)), short_number(q(2)), short_number(q(3))}},
            {"weights", std::move(weights)},
            {"extras", {{"step", model.labels[f].step}}}};
}

//! The largest distance of any point, decoded and put together as a viewer does it, from where it belongs.
double decoded_error(const PreviewModel& model, const std::vector<MorphTarget>& targets, const std::vector<Placed>& all,
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
                p += all[f].weights(k) * targets[k].scale * targets[k].points.col(base.order[i]);
            }
            const Vec3 seen = unit * mirror.cwiseProduct(turn * p + all[f].translation);
            worst = std::max(worst, (seen - truth.points[base.order[i]]).norm());
        }
    }
    return worst;
}

//! The mean element as a stream, and what a viewer reads in it.
struct CompressedBase
{
    DracoStream stream;
    DracoMesh decoded;
};

Expected<CompressedBase> compressed_base(const PreviewModel& model, const SolidElement& mean, const Grid& grid)
{
    DracoMesh mesh;
    for (std::size_t i = 0; i < mean.points.size(); ++i) {
        mesh.points.push_back((mean.points[i] / grid.unit).cast<float>());
        mesh.normals.push_back(mean.normals[i].cast<float>());
        mesh.order.push_back(static_cast<std::uint16_t>(i));
    }
    mesh.triangles = solid_triangles(model.bent.sheet, Outward::Front);
    return compress(mesh, point_grid(mesh.points, 0.5 * grid.step / grid.unit), normal_bits)
        .and_then([](DracoStream stream) {
            return decompress(stream).map([&](DracoMesh decoded) {
                return CompressedBase{std::move(stream), std::move(decoded)};
            });
        });
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

Expected<CompressedPreview> write(const PreviewModel& model, const PreviewOptions& options, const CompressedBase& base,
                                  const std::vector<MorphTarget>& targets, const std::vector<Placed>& all,
                                  const Grid& grid)
{
    Glb glb = make_glb(model.title);
    glb.json["extensionsUsed"] = {"KHR_draco_mesh_compression", "KHR_mesh_quantization"};
    glb.json["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_mesh_quantization"};
    add_materials(glb, options.lamp == LampLook::On);
    const DracoMesh& mesh = base.decoded;
    const int view = add_view(glb, base.stream.bytes, ViewTarget::None);
    const int points = add_accessor(glb, -1, Component::Float, "VEC3", mesh.points.size());
    set_bounds(glb, points, mesh.points);
    const int normals = add_accessor(glb, -1, Component::Float, "VEC3", mesh.normals.size());
    const int indices = add_accessor(glb, -1, Component::UInt16, "SCALAR", 3 * mesh.triangles.size());
    Json primitive{{"attributes", {{"POSITION", points}, {"NORMAL", normals}}}, {"indices", indices}};
    primitive["targets"] = add_targets(glb, targets, mesh.order);
    primitive["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", base.stream.point_id}, {"NORMAL", base.stream.normal_id}}}};
    add_meshes(glb, model, primitive, targets.size());
    add_nodes(glb, model, all, grid.unit);
    return CompressedPreview{glb_bytes(glb), decoded_error(model, targets, all, mesh, grid.unit),
                             static_cast<int>(targets.size()) - 1};
}

Expected<CompressedPreview> in_steps(const PreviewModel& model, const PreviewOptions& options, double step_mm,
                                     int short_steps)
{
    const BendingModes& modes = model.modes;
    const MorphedElement element = morphed_element(model, step_mm, short_steps);
    const Expected<CompressedBase> base = compressed_base(model, element.mean, element.grid);
    if (!base) {
        return tl::make_unexpected(base.error());
    }
    std::vector<Placed> all;
    for (std::size_t f = 0; f < modes.poses.size(); ++f) {
        all.push_back(placed(modes, element.targets, model.bent.elements[f].outward, f, element.grid));
    }
    return write(model, options, *base, element.targets, all, element.grid);
}

} // namespace

Expected<CompressedPreview> modes_glb(const PreviewModel& model, const PreviewOptions& options)
{
    // Rounding errors of many modes add up by chance: take what is smallest of what holds the tolerance.
    Expected<CompressedPreview> best;
    for (const int short_steps : {127, 400, 1200}) {
        Expected<CompressedPreview> made;
        for (double share = 0.6; share > 0.02; share *= 0.75) {
            made = in_steps(model, options, share * options.tolerance_mm, short_steps);
            if (!made || made->max_error_mm <= options.tolerance_mm) {
                break;
            }
        }
        const bool good = made && made->max_error_mm <= options.tolerance_mm;
        if (model.modes.grain.size() > 0) {
            return made;
        }
        if (!best || best->bytes.empty() || (good && made->bytes.size() < best->bytes.size())) {
            best = std::move(made);
        }
    }
    return best;
}

} // namespace rhombloom
