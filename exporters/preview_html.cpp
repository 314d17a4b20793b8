#include "exporters/preview_html.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <zlib.h>

#include "core/text.h"
#include "exporters/markup.h"
#include "exporters/sha256.h"

namespace rhombloom {

namespace {

using Json = nlohmann::ordered_json;

//! \name Packing
//! \{

//! Whole numbers, bytes sorted by significance: what deflate compresses best.
template <class Numbers>
void append(std::string& bytes, const Numbers& values, int size)
{
    for (int b = 0; b < size; ++b) {
        for (const auto value : values) {
            bytes.push_back(static_cast<char>(static_cast<std::uint32_t>(static_cast<std::int32_t>(value)) >> (8 * b)));
        }
    }
}

std::vector<std::int32_t> rounded(const Eigen::VectorXd& values, double scale)
{
    std::vector<std::int32_t> result;
    for (const double v : values) {
        result.push_back(static_cast<std::int32_t>(std::lround(v * scale)));
    }
    return result;
}

std::string deflated(const std::string& bytes)
{
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string result(size, '\0');
    const int status = compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                                 reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 9);
    expects(status == Z_OK, "deflated: the buffer is large enough");
    result.resize(size);
    return result;
}

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

//! \}

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
    append(bytes, std::array<std::size_t, 1>{json.size()}, 4);
    bytes += json;
    append(bytes, triangle_differences(model.bent.sheet), 2);
    append(bytes, rounded(flat_points(model.bent.sheet), 1 / packed.unit), 2);
    append(bytes, packed.mean, 2);
    append(bytes, rounded(mean_normals(modes, elements), 127), 1);
    for (const auto& mode : packed.modes) {
        append(bytes, mode, 2);
    }
    append(bytes, packed.origins, 4);
    append(bytes, packed.turns, 2);
    std::vector<int> facing;
    std::vector<int> component;
    std::vector<int> neighbours;
    for (std::size_t f = 0; f < elements.size(); ++f) {
        facing.push_back(elements[f].outward == Outward::Back ? 1 : 0);
        component.push_back(f < model.labels.size() ? model.labels[f].component : 0);
        const auto around = f < steps.neighbours.size() ? steps.neighbours[f] : std::array<int, 4>{-1, -1, -1, -1};
        neighbours.insert(neighbours.end(), around.begin(), around.end());
    }
    append(bytes, facing, 1);
    append(bytes, component, 2);
    for (const auto& weights : packed.weights) {
        append(bytes, weights, 2);
    }
    append(bytes, neighbours, 4);
    return base64(deflated(bytes));
}

//! \name The page
//! \{

Expected<std::string> viewer_part(const std::string& name)
{
    return load_file(std::string(RHOMBLOOM_TEMPLATES) + "/" + name, 1'000'000);
}

//! Without indentation and without lines that are only a comment.
std::string lean(const std::string& text)
{
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::size_t first = std::min(text.find_first_not_of(' ', at), end);
        if (first < end && text.compare(first, 2, "//") != 0) {
            result.append(text, first, end - first);
            result.push_back('\n');
        }
        at = end + 1;
    }
    return result;
}

//! "'sha256-...'" of an inline script or style, for the content security policy.
std::string source_hash(const std::string& text)
{
    const std::string hex = sha256(text);
    std::string digest;
    for (std::size_t i = 0; i < hex.size(); i += 2) {
        digest.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    }
    return "'sha256-" + base64(digest) + "'";
}

//! The template with every "@NAME@" replaced; what is put in is not looked at again.
std::string filled(const std::string& page, const std::map<std::string, std::string>& values)
{
    std::string result;
    std::size_t at = 0;
    while (at < page.size()) {
        const std::size_t open = page.find('@', at);
        const std::size_t close = open == std::string::npos ? open : page.find('@', open + 1);
        if (close == std::string::npos) {
            break;
        }
        const auto value = values.find(page.substr(open + 1, close - open - 1));
        result.append(page, at, (value == values.end() ? close : open) - at);
        result += value == values.end() ? "" : value->second;
        at = value == values.end() ? close : close + 1;
    }
    return result.append(page, std::min(at, page.size()), std::string::npos);
}

Expected<std::string> assembled(const std::string& title, const std::string& data)
{
    const Expected<std::string> page = viewer_part("viewer.html");
    const Expected<std::string> style = viewer_part("viewer.css");
    const Expected<std::string> script = viewer_part("viewer.js");
    for (const auto* part : {&page, &style, &script}) {
        if (!*part) {
            return tl::make_unexpected(part->error());
        }
    }
    const std::string css = lean(*style);
    const std::string js = lean(*script);
    const std::string policy = "default-src 'none'; script-src " + source_hash(js) + "; style-src " + source_hash(css) +
                               "; base-uri 'none'; form-action 'none'";
    return filled(
        *page, {{"POLICY", policy}, {"TITLE", markup_escaped(title)}, {"STYLE", css}, {"SCRIPT", js}, {"DATA", data}});
}

//! \}

} // namespace

Expected<PreviewSteps> preview_steps(const Replay& replay, const AssemblyPlan& plan, const Element& element)
{
    PreviewSteps result;
    result.steps = plan.steps;
    for (const Face f : replay.surface.faces()) {
        std::array<int, 4> around{};
        for (int k = 0; k < 4; ++k) {
            const Halfedge other = replay.surface.opposite_halfedge_handle(side_halfedge(replay.surface, f, k));
            around[k] = replay.surface.is_boundary(other) ? -1 : replay.surface.face_handle(other).idx();
        }
        result.neighbours.push_back(around);
    }
    std::map<int, BentSurface> stages;
    for (const TemporaryElement& t : plan.temporary) {
        if (!stages.contains(t.stage)) {
            Expected<BentSurface> bent = bent_surface(replay.stages.at(t.stage).surface, element);
            if (!bent) {
                return tl::make_unexpected(bent.error());
            }
            stages.emplace(t.stage, std::move(*bent));
        }
        result.temporary.push_back(stages.at(t.stage).elements.at(t.face));
    }
    return result;
}

Expected<PreviewPage> preview_page(const PreviewModel& model, const PreviewSteps& steps, const Element& element,
                                   const PreviewOptions& options)
{
    constexpr int most_modes = 64;
    BentSurface all{model.bent.sheet, model.bent.elements, {}};
    all.elements.insert(all.elements.end(), steps.temporary.begin(), steps.temporary.end());
    const BendingModes modes = bending_modes(all, 0.6 * options.tolerance_mm, most_modes);
    const double reach = std::max(element.lb + element.la, modes.mean.cwiseAbs().maxCoeff());
    // Where the modes are not enough, rounding need not be finer than what they leave out.
    const double step = std::max(0.2 * options.tolerance_mm, error_mm(modes, all) / 6);
    const PackedShapes packed = pack(modes, all.elements, step, reach);
    const Json head = header(model, steps, packed, element, options);
    const Expected<std::string> html = assembled(model.title.empty() ? "rhombloom preview" : model.title,
                                                 payload(model, steps, head, packed, modes, all.elements));
    if (!html) {
        return tl::make_unexpected(html.error());
    }
    return PreviewPage{*html, packed_error(packed, all.elements)};
}

} // namespace rhombloom
