#include <bit>
#include <cstring>

#include "exporters/mesh_formats.h"

namespace rhombloom {

namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t facet_bytes = 50;

std::uint32_t little_endian(const char* bytes)
{
    std::uint32_t value = 0;
    for (int k = 3; k >= 0; --k) {
        value = value << 8 | static_cast<unsigned char>(bytes[k]);
    }
    return value;
}

double little_endian_float(const char* bytes)
{
    return std::bit_cast<float>(little_endian(bytes));
}

void add_facet(const std::array<Vec3, 3>& corners, TriangleMesh& mesh)
{
    const int first = static_cast<int>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
}

Expected<MeshFile> read_binary(std::string_view bytes, std::size_t count)
{
    MeshFile file;
    file.mesh.points.reserve(3 * count);
    file.mesh.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const char* facet = bytes.data() + header_bytes + i * facet_bytes + 12; // after the normal
        std::array<Vec3, 3> corners;
        for (int k = 0; k < 9; ++k) {
            corners[k / 3][k % 3] = little_endian_float(facet + 4 * k);
        }
        add_facet(corners, file.mesh);
    }
    return file;
}

std::string lower_case(std::string_view word)
{
    std::string result(word.substr(0, 20));
    for (char& c : result) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return result;
}

Expected<MeshFile> read_text(std::string_view bytes)
{
    MeshFile file;
    TextScanner scanner(bytes);
    std::array<Vec3, 3> corners;
    int known = 0;
    while (scanner.next_line()) {
        const std::string keyword = lower_case(scanner.word());
        if (keyword == "facet" || keyword == "endfacet") {
            known = 0;
        }
        if (keyword != "vertex") {
            continue;
        }
        Vec3 p;
        if (!scanner.number(p.x()) || !scanner.number(p.y()) || !scanner.number(p.z()) || known == 3) {
            return refuse("line " + std::to_string(scanner.line_number()) +
                          " is not the point of a triangle: expected three of three coordinates each");
        }
        corners[known++] = p;
        if (known == 3) {
            add_facet(corners, file.mesh);
        }
    }
    return file;
}

} // namespace

Expected<MeshFile> read_stl(std::string_view bytes)
{
    // Some programs indent the word or write it in capitals; some begin a binary file with it.
    const bool says_solid = lower_case(TextScanner(bytes.substr(0, header_bytes)).any_word()) == "solid";
    if (bytes.size() >= header_bytes) {
        const std::size_t count = little_endian(bytes.data() + 80);
        const std::size_t announced = header_bytes + count * facet_bytes;
        if (bytes.size() >= announced && (!says_solid || bytes.size() == announced)) {
            return read_binary(bytes, count);
        }
        if (!says_solid) {
            return refuse("the file announces " + std::to_string(count) + " triangles, " + std::to_string(announced) +
                          " bytes, but has " + std::to_string(bytes.size()) + ": it is cut short");
        }
    }
    if (!says_solid) {
        return refuse("the file is no STL: it neither begins with \"solid\" nor has the 84 bytes of a binary header");
    }
    auto text = read_text(bytes);
    const std::size_t count = bytes.size() < header_bytes ? 0 : little_endian(bytes.data() + 80);
    const bool binary = text && text->mesh.triangles.empty() && bytes.size() >= header_bytes + count * facet_bytes;
    return binary ? read_binary(bytes, count) : text;
}

} // namespace rhombloom
