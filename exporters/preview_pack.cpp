#include "exporters/preview_pack.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "exporters/pdf_objects.h"

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::int32_t> rounded(const Eigen::VectorXd& values, double scale)
{
    std::vector<std::int32_t> result;
    for (const double v : values) {
        result.push_back(static_cast<std::int32_t>(std::lround(v * scale)));
    }
    return result;
}

//! Modes, weights and poses in whole numbers.
struct PackedShapes
{
    double unit = 0.01; //!< mm
    std::vector<std::int32_t> mean;
    std::vector<std::vector<std::int32_t>> modes;
    std::vector<std::vector<std::int32_t>> weights; //!< one list per mode
    std::vector<double> scales;                     //!< mm per mode unit and weight unit
    std::vector<std::int32_t> origins;
    std::vector<std::int32_t> turns; //!< quaternions of the frames, third row negated when turned over
};

//! A mode in units of the grid at its largest weight, and weights in steps that move no point by more than that.
void pack_mode(const BendingModes& modes, int k, double step, PackedShapes& packed)
{
    Eigen::VectorXd weights(modes.poses.size());
    for (std::size_t f = 0; f < modes.poses.size(); ++f) {
        weights(static_cast<int>(f)) = modes.poses[f].weights(k);
    }
    const double largest = std::max(weights.cwiseAbs().maxCoeff(), 1e-9);
    const double reach = largest * modes.modes.col(k).cwiseAbs().maxCoeff();
    const double fine = std::max(step, reach / 32000);
    const double steps = std::clamp(std::ceil(reach / step), 1.0, 32000.0);
    packed.modes.push_back(rounded(modes.modes.col(k), largest / fine));
    packed.weights.push_back(rounded(weights, steps / largest));
    packed.scales.push_back(fine / steps);
}

PackedShapes pack(const BendingModes& modes, const std::vector<BentElement>& elements, double step, double reach)
{
    PackedShapes packed;
    packed.unit = std::max(step, 1.1 * reach / 32767);
    packed.mean = rounded(modes.mean, 1 / packed.unit);
    for (int k = 0; k < modes.modes.cols(); ++k) {
        pack_mode(modes, k, step, packed);
    }
    Eigen::MatrixXd turns(4, modes.poses.size());
    Eigen::MatrixXd origins(3, modes.poses.size());
    for (int f = 0; f < turns.cols(); ++f) {
        const Vec3 mirror(1, 1, sign(elements[f].outward));
        const Eigen::Quaterniond q(Eigen::Matrix3d(mirror.asDiagonal() * modes.poses[f].axes));
        turns.col(f) = q.coeffs() * (q.w() < 0 ? -1 : 1);
        origins.col(f) = modes.poses[f].origin;
    }
    packed.turns = rounded(turns.reshaped(), 32767);
    packed.origins = rounded(origins.reshaped(), 1 / packed.unit);
    return packed;
}

//! The page's arithmetic (viewer.js, `place`) on the packed numbers, against the truth.
double packed_error(const PackedShapes& packed, const std::vector<BentElement>& elements)
{
    double worst = 0;
    for (std::size_t f = 0; f < elements.size(); ++f) {
        const Eigen::Vector4d q(packed.turns[4 * f], packed.turns[4 * f + 1], packed.turns[4 * f + 2],
                                packed.turns[4 * f + 3]);
        const Vec3 mirror(1, 1, sign(elements[f].outward));
        const Eigen::Matrix3d axes = mirror.asDiagonal() * Eigen::Quaterniond(q.normalized()).toRotationMatrix();
        for (std::size_t i = 0; i < elements[f].points.size(); ++i) {
            Vec3 p;
            for (int r = 0; r < 3; ++r) {
                p(r) = packed.unit * packed.mean[3 * i + r];
                for (std::size_t k = 0; k < packed.modes.size(); ++k) {
                    p(r) += packed.scales[k] * packed.weights[k][f] * packed.modes[k][3 * i + r];
                }
            }
            const Vec3 o(packed.origins[3 * f], packed.origins[3 * f + 1], packed.origins[3 * f + 2]);
            worst = std::max(worst, (packed.unit * o + axes * p - elements[f].points[i]).norm());
        }
    }
    return worst;
}

//! The flat piece about its middle, in the order x, y.
Eigen::VectorXd flat_points(const FlatSheet& sheet)
{
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : sheet.points) {
        middle += p / static_cast<double>(sheet.points.size());
    }
    Eigen::VectorXd flat(2 * sheet.points.size());
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        flat.segment<2>(static_cast<int>(2 * i)) = sheet.points[i] - middle;
    }
    return flat;
}

Eigen::VectorXd mean_normals(const BendingModes& modes, const std::vector<BentElement>& elements)
{
    Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, modes.mean.size() / 3);
    for (std::size_t f = 0; f < elements.size(); ++f) {
        for (int i = 0; i < sum.cols(); ++i) {
            sum.col(i) += modes.poses[f].axes.transpose() * elements[f].normals[i];
        }
    }
    sum.colwise().normalize();
    return sum.reshaped();
}

std::vector<std::int32_t> triangle_differences(const FlatSheet& sheet)
{
    std::vector<std::int32_t> list;
    int before = 0;
    for (const auto& t : sheet.triangles) {
        for (const int v : t) {
            list.push_back(v - before);
            before = v;
        }
    }
    return list;
}

double model_size(const BentSurface& bent)
{
    Eigen::AlignedBox3d box;
    for (const BentElement& e : bent.elements) {
        for (const Vec3& p : e.points) {
            box.extend(p);
        }
    }
    return box.sizes().maxCoeff();
}

Json header(const PreviewModel& model, const PreviewSteps& steps, const PackedShapes& packed, const Element& element,
            const PreviewOptions& options)
{
    Json list = Json::array();
    for (const Step& s : steps.steps) {
        list.push_back({static_cast<int>(s.kind), s.element, s.joins.size()});
    }
    Json scales = Json::array();
    for (const double s : packed.scales) {
        scales.push_back(s);
    }
    const FlatSheet& sheet = model.bent.sheet;
    return {{"points", sheet.points.size()},
            {"rim", sheet.rim},
            {"triangles", sheet.triangles.size()},
            {"modes", packed.modes.size()},
            {"elements", model.bent.elements.size() + steps.temporary.size()},
            {"final", model.bent.elements.size()},
            {"unit", packed.unit},
            {"scales", std::move(scales)},
            {"la", element.la},
            {"size_mm", std::round(model_size(model.bent))},
            {"lit", options.lamp == LampLook::On},
            {"components", model.components},
            {"steps", std::move(list)}};
}

std::string payload(const PreviewModel& model, const PreviewSteps& steps, const Json& head, const PackedShapes& packed,
                    const BendingModes& modes, const std::vector<BentElement>& elements)
{
    std::string json = head.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string bytes;
    append_sorted_bytes(bytes, std::array<std::size_t, 1>{json.size()}, 4);
    bytes += json;
    append_sorted_bytes(bytes, triangle_differences(model.bent.sheet), 2);
    append_sorted_bytes(bytes, rounded(flat_points(model.bent.sheet), 1 / packed.unit), 2);
    append_sorted_bytes(bytes, packed.mean, 2);
    append_sorted_bytes(bytes, rounded(mean_normals(modes, elements), 127), 1);
    for (const auto& mode : packed.modes) {
        append_sorted_bytes(bytes, mode, 2);
    }
    append_sorted_bytes(bytes, packed.origins, 4);
    append_sorted_bytes(bytes, packed.turns, 2);
    std::vector<int> facing;
    std::vector<int> component;
    std::vector<int> neighbours;
    for (std::size_t f = 0; f < elements.size(); ++f) {
        facing.push_back(elements[f].outward == Outward::Back ? 1 : 0);
        component.push_back(f < model.labels.size() ? model.labels[f].component : 0);
        const auto around = f < steps.neighbours.size() ? steps.neighbours[f] : std::array<int, 4>{-1, -1, -1, -1};
        neighbours.insert(neighbours.end(), around.begin(), around.end());
    }
    append_sorted_bytes(bytes, facing, 1);
    append_sorted_bytes(bytes, component, 2);
    for (const auto& weights : packed.weights) {
        append_sorted_bytes(bytes, weights, 2);
    }
    append_sorted_bytes(bytes, neighbours, 4);
    return packed_text(bytes);
}

} // namespace

std::string base64(const std::string& bytes)
{
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto at = [&](std::size_t k) { return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U; };
        const unsigned word = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
        for (int k = 0; k < 4; ++k) {
            text.push_back(i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63]);
        }
    }
    return text;
}

std::string packed_text(const std::string& bytes)
{
    return base64(deflated({bytes}).front());
}

PackedPreview packed_preview(const PreviewModel& model, const PreviewSteps& steps, const Element& element,
                             const PreviewOptions& options)
{
    std::vector<BentElement> all = model.bent.elements;
    all.insert(all.end(), steps.temporary.begin(), steps.temporary.end());
    BendingModes modes = model.modes;
    modes.poses.insert(modes.poses.end(), steps.temporary_poses.begin(), steps.temporary_poses.end());
    const double reach = std::max(element.lb + element.la, modes.mean.cwiseAbs().maxCoeff());
    const PackedShapes packed = pack(modes, all, 0.2 * options.tolerance_mm, reach);
    const Json head = header(model, steps, packed, element, options);
    return {payload(model, steps, head, packed, modes, all), packed_error(packed, all)};
}

} // namespace rhombloom
