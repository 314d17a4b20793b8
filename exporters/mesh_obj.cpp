#include "exporters/mesh_formats.h"

namespace rhombloom {

namespace {

std::string line_name(const TextScanner& scanner)
{
    return "line " + std::to_string(scanner.line_number());
}

//! The index before the first slash; negative ones count from the last point read.
Expected<int> corner(std::string_view word, std::size_t points, const TextScanner& scanner)
{
    long long index = 0;
    if (!parse_integer(word.substr(0, word.find('/')), index)) {
        return refuse(line_name(scanner) + " has the face corner \"" + std::string(word.substr(0, 40)) +
                      "\": expected the number of a point");
    }
    const long long count = static_cast<long long>(points);
    const long long number = index < 0 ? count + index : index - 1;
    if (number < 0 || number >= count) {
        return refuse(line_name(scanner) + " has a face with point " + std::to_string(index) + ", but there are " +
                      std::to_string(count) + " points before it");
    }
    return static_cast<int>(number);
}

Expected<void> read_face(TextScanner& scanner, TriangleMesh& mesh)
{
    std::vector<int> corners;
    for (auto word = scanner.word(); !word.empty(); word = scanner.word()) {
        const auto number = corner(word, mesh.points.size(), scanner);
        if (!number) {
            return tl::make_unexpected(number.error());
        }
        corners.push_back(*number);
    }
    add_polygon(corners, mesh);
    return {};
}

} // namespace

Expected<MeshFile> read_obj(std::string_view bytes)
{
    MeshFile file;
    TextScanner scanner(bytes);
    while (scanner.next_line()) {
        const auto keyword = scanner.word();
        if (keyword == "v") {
            Vec3 p;
            if (!scanner.number(p.x()) || !scanner.number(p.y()) || !scanner.number(p.z())) {
                return refuse(line_name(scanner) + " is a point without three coordinates");
            }
            file.mesh.points.push_back(p);
        } else if (keyword == "f") {
            if (auto ok = read_face(scanner, file.mesh); !ok) {
                return tl::make_unexpected(ok.error());
            }
        }
    }
    return file;
}

} // namespace rhombloom
