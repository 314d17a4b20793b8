#include "exporters/draco_mesh.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <draco/compression/attributes/normal_compression_utils.h>
#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>

namespace rhombloom {

namespace {

template <class Value>
int add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type kind, draco::DataType type, int components,
                  const std::vector<Value>& values)
{
    if (values.empty()) {
        return -1;
    }
    draco::GeometryAttribute attribute;
    attribute.Init(kind, nullptr, static_cast<std::uint8_t>(components), type, false, sizeof(Value), 0);
    const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(static_cast<std::uint32_t>(i)), &values[i]);
    }
    return id;
}

//! Attribute ids of our four kinds in a Draco mesh.
struct Ids
{
    int point;
    int normal;
    int element;
    int order;
};

Ids fill(draco::Mesh& out, const DracoMesh& mesh)
{
    out.set_num_points(static_cast<std::uint32_t>(mesh.points.size()));
    Ids ids{};
    ids.point = add_attribute(out, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, mesh.points);
    ids.normal = add_attribute(out, draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, 3, mesh.normals);
    ids.element = add_attribute(out, draco::GeometryAttribute::GENERIC, draco::DT_UINT16, 1, mesh.elements);
    ids.order = add_attribute(out, draco::GeometryAttribute::GENERIC, draco::DT_UINT16, 1, mesh.order);
    out.SetNumFaces(mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        draco::Mesh::Face face;
        for (int k = 0; k < 3; ++k) {
            face[k] = draco::PointIndex(static_cast<std::uint32_t>(mesh.triangles[f][k]));
        }
        out.SetFace(draco::FaceIndex(static_cast<std::uint32_t>(f)), face);
    }
    return ids;
}

int unique_id(const draco::Mesh& mesh, int id)
{
    return id < 0 ? -1 : static_cast<int>(mesh.attribute(id)->unique_id());
}

template <class Value>
std::vector<Value> read_attribute(const draco::Mesh& mesh, int id)
{
    std::vector<Value> values;
    if (id < 0) {
        return values;
    }
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
    values.resize(mesh.num_points());
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
        attribute->GetValue(attribute->mapped_index(draco::PointIndex(i)), &values[i]);
    }
    return values;
}

//! The extent that the lattice's numbers of so many bits cover.
float range_of(const PointGrid& grid)
{
    return static_cast<float>(grid.step * (std::exp2(grid.bits) - 1));
}

using LatticePoint = Eigen::Matrix<std::int64_t, 3, 1>;

//! The decoder's sum of area vectors as the direction it predicts, in its whole numbers.
Eigen::Vector3f predicted_direction(LatticePoint sum, const draco::OctahedronToolBox& box)
{
    constexpr std::int64_t most = 1 << 29;
    const std::int64_t size = sum.cwiseAbs().sum();
    if (size > most) {
        sum /= size / most;
    }
    std::array<std::int32_t, 3> whole{};
    for (int k = 0; k < 3; ++k) {
        whole[k] = static_cast<std::int32_t>(sum(k));
    }
    box.CanonicalizeIntegerVector(whole.data());
    return Eigen::Vector3i(whole[0], whole[1], whole[2]).cast<float>().normalized();
}

} // namespace

PointGrid point_grid(const std::vector<Eigen::Vector3f>& points, double tolerance)
{
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& p : points) {
        box.extend(p);
    }
    // The cell's half diagonal is the largest error; leave a little for the float arithmetic of decoders. Draco passes
    // origin and extent on with six decimals: numbers that have no more arrive as they are.
    constexpr double micro = 1e-6;
    PointGrid grid;
    grid.origin = ((box.min().cast<double>() / micro).array().floor() * micro).cast<float>();
    grid.step = 2 * 0.98 * tolerance / std::sqrt(3.0);
    const double cells = static_cast<double>((box.max() - grid.origin).maxCoeff()) / grid.step + 1;
    grid.bits = std::clamp(static_cast<int>(std::ceil(std::log2(cells + 1))), 2, 30);
    const double most = std::exp2(grid.bits) - 1;
    grid.step = std::ceil(grid.step * most / micro) * micro / most;
    return grid;
}

std::vector<Eigen::Vector3f> expected_normals(const DracoMesh& mesh, const PointGrid& grid, int normal_bits,
                                              double within_deg)
{
    std::vector<LatticePoint> places;
    for (const Eigen::Vector3f& p : mesh.points) {
        places.emplace_back(((p - grid.origin).cast<double>() / grid.step).array().round().cast<std::int64_t>());
    }
    std::vector<LatticePoint> sums(places.size(), LatticePoint::Zero());
    for (const auto& t : mesh.triangles) {
        const LatticePoint area = (places[t[1]] - places[t[0]]).cross(places[t[2]] - places[t[0]]);
        for (const int corner : t) {
            sums[corner] += area;
        }
    }
    draco::OctahedronToolBox box;
    box.SetQuantizationBits(normal_bits);
    const auto least = static_cast<float>(std::cos(within_deg * std::acos(-1.0) / 180));
    std::vector<Eigen::Vector3f> normals = mesh.normals;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Eigen::Vector3f direction = predicted_direction(sums[i], box);
        if (direction.dot(normals[i]) >= least) {
            normals[i] = direction;
        }
    }
    return normals;
}

Expected<DracoStream> compress(const DracoMesh& mesh, const PointGrid& grid, int normal_bits)
{
    draco::Mesh source;
    const Ids ids = fill(source, mesh);
    draco::ExpertEncoder encoder(source);
    // The slowest speed for its order of the points; its prediction from many parallelograms at once would save 2 %
    // of the points' bytes and cost half the time, for element numbers nothing and a quarter of the time.
    encoder.SetSpeedOptions(0, 0);
    encoder.SetAttributePredictionScheme(ids.point, draco::MESH_PREDICTION_PARALLELOGRAM);
    for (const int id : {ids.element, ids.order}) {
        if (id >= 0) {
            encoder.SetAttributePredictionScheme(id, draco::PREDICTION_DIFFERENCE);
        }
    }
    encoder.SetAttributeExplicitQuantization(ids.point, grid.bits, 3, grid.origin.data(), range_of(grid));
    if (ids.normal >= 0) {
        encoder.SetAttributeQuantization(ids.normal, normal_bits);
    }
    draco::EncoderBuffer buffer;
    const draco::Status status = encoder.EncodeToBuffer(&buffer);
    if (!status.ok()) {
        return machine_failure(std::string("the preview could not be compressed: ") + status.error_msg());
    }
    DracoStream stream;
    stream.bytes.assign(buffer.data(), buffer.size());
    stream.point_id = unique_id(source, ids.point);
    stream.normal_id = unique_id(source, ids.normal);
    stream.element_id = unique_id(source, ids.element);
    stream.order_id = unique_id(source, ids.order);
    return stream;
}

Expected<DracoMesh> decompress(const DracoStream& stream)
{
    draco::DecoderBuffer buffer;
    buffer.Init(stream.bytes.data(), stream.bytes.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) {
        return machine_failure(std::string("the preview's mesh could not be read back: ") +
                               result.status().error_msg());
    }
    const draco::Mesh& mesh = *result.value();
    DracoMesh decoded;
    decoded.points = read_attribute<Eigen::Vector3f>(mesh, stream.point_id);
    decoded.normals = read_attribute<Eigen::Vector3f>(mesh, stream.normal_id);
    decoded.elements = read_attribute<std::uint16_t>(mesh, stream.element_id);
    decoded.order = read_attribute<std::uint16_t>(mesh, stream.order_id);
    for (std::uint32_t f = 0; f < mesh.num_faces(); ++f) {
        const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(f));
        decoded.triangles.push_back(
            {static_cast<int>(face[0].value()), static_cast<int>(face[1].value()), static_cast<int>(face[2].value())});
    }
    return decoded;
}

std::vector<Eigen::Vector3f> on_grid(const std::vector<Eigen::Vector3f>& points, const PointGrid& grid)
{
    const auto cells = static_cast<float>(std::exp2(grid.bits) - 1);
    const float to_cells = cells / range_of(grid);
    const float step = range_of(grid) / cells;
    std::vector<Eigen::Vector3f> places;
    places.reserve(points.size());
    for (const Eigen::Vector3f& p : points) {
        const Eigen::Array3f cell = ((p - grid.origin).array() * to_cells + 0.5F).floor();
        places.emplace_back((cell * step).matrix() + grid.origin);
    }
    return places;
}

} // namespace rhombloom
