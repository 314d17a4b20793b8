#include "exporters/mesh_formats.h"

namespace rhombloom {

namespace {

Expected<Vec3> read_point(TextScanner& scanner, bool own_line)
{
    if (own_line && !scanner.next_line()) {
        return refuse("the file ends before its last point");
    }
    Vec3 p;
    if (!scanner.number(p.x()) || !scanner.number(p.y()) || !scanner.number(p.z())) {
        return refuse("line " + std::to_string(scanner.line_number()) + " is a point without three coordinates");
    }
    return p;
}

Expected<void> read_face(TextScanner& scanner, TriangleMesh& mesh)
{
    const auto line = [&] { return "line " + std::to_string(scanner.line_number()); };
    long long count = 0;
    if (!scanner.next_line()) {
        return refuse("the file ends before its last face");
    }
    if (!scanner.integer(count) || count < 0 || count > 100000) {
        return refuse(line() + " does not begin with the number of a face's corners");
    }
    std::vector<int> corners;
    for (long long k = 0; k < count; ++k) {
        long long index = 0;
        if (!scanner.integer(index) || index < 0 || index >= static_cast<long long>(mesh.points.size())) {
            return refuse(line() + " has a face with an unknown point: expected " + std::to_string(count) +
                          " numbers from 0 to " + std::to_string(mesh.points.size() - 1));
        }
        corners.push_back(static_cast<int>(index));
    }
    add_polygon(corners, mesh);
    return {};
}

} // namespace

Expected<MeshFile> read_off(std::string_view bytes)
{
    MeshFile file;
    TextScanner scanner(bytes);
    std::string_view word = scanner.any_word();
    if (word.size() >= 3 && word.substr(word.size() - 3) == "OFF") {
        word = scanner.any_word();
    }
    long long points = 0;
    long long faces = 0;
    if (!parse_integer(word, points) || !parse_integer(scanner.any_word(), faces) || points < 0 || faces < 0) {
        return refuse("the file does not begin with OFF and the numbers of points and faces");
    }
    const auto size = static_cast<long long>(bytes.size());
    if (points > size || faces > size) {
        return refuse("the file announces " + std::to_string(points) + " points and " + std::to_string(faces) +
                      " faces, but ends before");
    }
    for (long long i = 0; i < points; ++i) {
        const auto p = read_point(scanner, true);
        if (!p) {
            return tl::make_unexpected(p.error());
        }
        file.mesh.points.push_back(*p);
    }
    for (long long i = 0; i < faces; ++i) {
        if (auto ok = read_face(scanner, file.mesh); !ok) {
            return tl::make_unexpected(ok.error());
        }
    }
    return file;
}

} // namespace rhombloom
