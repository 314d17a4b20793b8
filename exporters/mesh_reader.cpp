#include "exporters/mesh_reader.h"

#include <charconv>
#include <map>

#include "exporters/mesh_formats.h"
#include "exporters/save.h"

namespace rhombloom {

namespace {

bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

} // namespace

bool parse_number(std::string_view word, double& value)
{
    if (!word.empty() && word.front() == '+') {
        word.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) {
        value = std::numeric_limits<double>::infinity();
        return true;
    }
    return error == std::errc() && end == word.data() + word.size();
}

bool parse_integer(std::string_view word, long long& value)
{
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

bool TextScanner::next_line()
{
    while (!rest_.empty()) {
        const auto end = rest_.find('\n');
        line_ = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        ++line_number_;
        line_ = line_.substr(0, line_.find('#'));
        while (!line_.empty() && is_space(line_.front())) {
            line_.remove_prefix(1);
        }
        if (!line_.empty()) {
            return true;
        }
    }
    line_ = {};
    return false;
}

std::string_view TextScanner::word()
{
    std::size_t begin = 0;
    while (begin < line_.size() && is_space(line_[begin])) {
        ++begin;
    }
    std::size_t end = begin;
    while (end < line_.size() && !is_space(line_[end])) {
        ++end;
    }
    const std::string_view result = line_.substr(begin, end - begin);
    line_.remove_prefix(end);
    return result;
}

bool TextScanner::number(double& value)
{
    return parse_number(word(), value);
}

bool TextScanner::integer(long long& value)
{
    return parse_integer(word(), value);
}

std::string_view TextScanner::any_word()
{
    std::string_view result = word();
    while (result.empty() && next_line()) {
        result = word();
    }
    return result;
}

void add_polygon(const std::vector<int>& corners, TriangleMesh& mesh)
{
    for (std::size_t k = 2; k < corners.size(); ++k) {
        mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
}

Expected<MeshFile> read_mesh(const std::string& name, const std::string& bytes)
{
    static const std::map<std::string, Expected<MeshFile> (*)(std::string_view)> readers = {
        {"obj", read_obj}, {"off", read_off}, {"stl", read_stl}, {"ply", read_ply}, {"glb", read_glb}};
    const auto reader = readers.find(file_ending(name));
    if (reader == readers.end()) {
        return refuse("the ending of the file's name is \"" + file_ending(name).substr(0, 20) +
                      "\": expected .obj, .ply, .stl, .off or .glb");
    }
    if (bytes.empty()) {
        return refuse("the file is empty");
    }
    auto file = reader->second(bytes);
    if (file && file->mesh.triangles.empty()) {
        return refuse("the file has " + std::to_string(file->mesh.points.size()) +
                      " points but no faces: expected a surface of triangles or polygons");
    }
    return file;
}

} // namespace rhombloom
