#include <algorithm>
#include <utility>

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

//! A point or face whose line ends in a backslash goes on in the next line, as some programs break long faces. The line
//! ends that were taken out follow, so that lines keep their numbers.
std::string joined_lines(std::string_view bytes)
{
    std::string text;
    text.reserve(bytes.size());
    std::size_t owed = 0;
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
        if (line.ends_with('\\') && (owed > 0 || line.starts_with('v') || line.starts_with('f'))) {
            line.remove_suffix(1);
            text.append(line).push_back(' ');
            ++owed;
        } else {
            text.append(line).append(1 + std::exchange(owed, 0), '\n');
        }
    }
    return text;
}

} // namespace

Expected<MeshFile> read_obj(std::string_view bytes)
{
    MeshFile file;
    const bool broken = bytes.find("\\\n") != bytes.npos || bytes.find("\\\r\n") != bytes.npos;
    const std::string joined = broken ? joined_lines(bytes) : "";
    TextScanner scanner(broken ? joined : bytes);
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
