#include "exporters/draco_mesh.h"

#include <algorithm>
#include <cmath>

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

Expected<DracoMesh> decode(const DracoStream& stream)
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

} // namespace

int quantisation_bits(double extent, double tolerance)
{
    // The grid's half diagonal is the largest error; leave a little for the float arithmetic of decoders.
    const double cells = extent * std::sqrt(3.0) / (2 * 0.98 * tolerance) + 1;
    return std::clamp(static_cast<int>(std::ceil(std::log2(cells))), 2, 30);
}

double extent(const std::vector<Eigen::Vector3f>& points)
{
    Eigen::Vector3f low = points.front();
    Eigen::Vector3f high = points.front();
    for (const Eigen::Vector3f& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return (high - low).maxCoeff();
}

Expected<DracoStream> compress(const DracoMesh& mesh, int point_bits, int normal_bits)
{
    draco::Mesh source;
    const Ids ids = fill(source, mesh);
    source.DeduplicateAttributeValues();
    source.DeduplicatePointIds();
    draco::ExpertEncoder encoder(source);
    encoder.SetSpeedOptions(1, 1);
    encoder.SetAttributeQuantization(ids.point, point_bits);
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
    Expected<DracoMesh> decoded = decode(stream);
    if (!decoded) {
        return tl::make_unexpected(decoded.error());
    }
    stream.decoded = std::move(*decoded);
    return stream;
}

} // namespace rhombloom
