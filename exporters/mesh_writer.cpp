#include "exporters/mesh_writer.h"

#include <bit>
#include <cstdint>

namespace rhombloom {

namespace {

void append(std::uint32_t value, std::string& out)
{
    for (int k = 0; k < 4; ++k) {
        out += static_cast<char>(value >> (8 * k) & 255);
    }
}

} // namespace

std::string write_ply(const TriangleMesh& mesh)
{
    std::string out = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& p : mesh.points) {
        for (const double x : p) {
            append(std::bit_cast<std::uint32_t>(static_cast<float>(x)), out);
        }
    }
    for (const Triangle& t : mesh.triangles) {
        out += '\3';
        for (const int v : t) {
            append(static_cast<std::uint32_t>(v), out);
        }
    }
    return out;
}

} // namespace rhombloom
