#pragma once

#include <string_view>

#include "exporters/mesh_reader.h"

namespace rhombloom {

// One reader per format; bytes are the whole file. Indices of the result are in range.
Expected<MeshFile> read_obj(std::string_view bytes);
Expected<MeshFile> read_off(std::string_view bytes);
Expected<MeshFile> read_stl(std::string_view bytes);
Expected<MeshFile> read_ply(std::string_view bytes);
Expected<MeshFile> read_glb(std::string_view bytes);

//! \brief Words of a text, one line at a time, without copying.
class TextScanner
{
public:
    explicit TextScanner(std::string_view text) : rest_(text) {}

    //! Step to the next line that has a word and is not a comment (#); false at the end.
    bool next_line();
    //! The next word of the line; empty at its end.
    std::string_view word();
    //! The next word as a number; false when it is none. "nan" and "inf" are numbers.
    bool number(double& value);
    bool integer(long long& value);
    //! The next word, on whatever line; empty at the end of the text.
    std::string_view any_word();
    int line_number() const { return line_number_; }
    //! What follows the present line.
    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
    std::string_view line_;
    int line_number_ = 0;
};

bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, long long& value);

//! \brief Cut a polygon into triangles from its first corner.
void add_polygon(const std::vector<int>& corners, TriangleMesh& mesh);

} // namespace rhombloom
