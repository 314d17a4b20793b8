#include <bit>
#include <map>
#include <optional>

#include "exporters/mesh_formats.h"

namespace rhombloom {

namespace {

enum class Encoding
{
    Text,
    Little,
    Big
};

struct Type
{
    int bytes = 4;
    bool real = false;
    bool is_signed = true;
};

struct Property
{
    std::string name;
    Type type;
    std::optional<Type> count; //!< a list: the type of its length
};

struct Block
{
    std::string name;
    long long count = 0;
    std::vector<Property> properties;
};

struct Header
{
    Encoding encoding = Encoding::Text;
    std::vector<Block> blocks;
};

std::optional<Type> type_named(std::string_view name)
{
    static const std::map<std::string_view, Type> types = {
        {"char", {1, false, true}},    {"int8", {1, false, true}},    {"uchar", {1, false, false}},
        {"uint8", {1, false, false}},  {"short", {2, false, true}},   {"int16", {2, false, true}},
        {"ushort", {2, false, false}}, {"uint16", {2, false, false}}, {"int", {4, false, true}},
        {"int32", {4, false, true}},   {"uint", {4, false, false}},   {"uint32", {4, false, false}},
        {"float", {4, true, true}},    {"float32", {4, true, true}},  {"double", {8, true, true}},
        {"float64", {8, true, true}}};
    const auto found = types.find(name);
    return found == types.end() ? std::nullopt : std::optional(found->second);
}

bool read_property(TextScanner& scanner, Block& block)
{
    Property property;
    std::string_view word = scanner.word();
    if (word == "list") {
        property.count = type_named(scanner.word());
        word = scanner.word();
        if (!property.count || property.count->real) {
            return false;
        }
    }
    const auto type = type_named(word);
    property.name = scanner.word();
    if (!type || property.name.empty()) {
        return false;
    }
    property.type = *type;
    block.properties.push_back(std::move(property));
    return true;
}

bool read_header_line(TextScanner& scanner, Header& header)
{
    const auto keyword = scanner.word();
    if (keyword == "format") {
        const auto name = scanner.word();
        header.encoding = name == "ascii"                  ? Encoding::Text
                          : name == "binary_little_endian" ? Encoding::Little
                                                           : Encoding::Big;
        return name == "ascii" || name == "binary_little_endian" || name == "binary_big_endian";
    }
    if (keyword == "element") {
        Block block;
        block.name = scanner.word();
        const bool good = scanner.integer(block.count) && block.count >= 0;
        header.blocks.push_back(std::move(block));
        return good;
    }
    if (keyword == "property") {
        return !header.blocks.empty() && read_property(scanner, header.blocks.back());
    }
    return keyword == "ply" || keyword == "comment" || keyword == "obj_info";
}

//! Hands out the numbers behind the header, whatever their encoding.
class Values
{
public:
    Values(std::string_view bytes, Encoding encoding) : bytes_(bytes), text_(bytes), encoding_(encoding) {}

    bool next(const Type& type, double& value)
    {
        if (encoding_ == Encoding::Text) {
            return parse_number(text_.any_word(), value);
        }
        if (bytes_.size() < static_cast<std::size_t>(type.bytes)) {
            return false;
        }
        std::uint64_t raw = 0;
        for (int k = 0; k < type.bytes; ++k) {
            const int at = encoding_ == Encoding::Big ? k : type.bytes - 1 - k;
            raw = raw << 8 | static_cast<unsigned char>(bytes_[at]);
        }
        bytes_.remove_prefix(type.bytes);
        value = decoded(type, raw);
        return true;
    }

private:
    static double decoded(const Type& type, std::uint64_t raw)
    {
        if (type.real) {
            return type.bytes == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)))
                                   : std::bit_cast<double>(raw);
        }
        if (!type.is_signed) {
            return static_cast<double>(raw);
        }
        const int unused = 64 - 8 * type.bytes;
        return static_cast<double>(static_cast<std::int64_t>(raw << unused) >> unused);
    }

    std::string_view bytes_;
    TextScanner text_;
    Encoding encoding_;
};

using Row = std::map<std::string_view, std::vector<double>>;

Expected<void> read_row(const Block& block, long long number, Values& values, Row& row)
{
    const auto fail = [&](const std::string& what) {
        return refuse(block.name + " " + std::to_string(number) + " of " + std::to_string(block.count) + " " + what);
    };
    for (const Property& property : block.properties) {
        std::vector<double>& cells = row[property.name];
        cells.clear();
        double count = 1;
        if (property.count && !values.next(*property.count, count)) {
            return fail("is cut short or not a number");
        }
        if (!(count >= 0 && count <= 100000)) {
            return fail("has a list of absurd length");
        }
        for (int k = 0; k < static_cast<int>(count); ++k) {
            double value = 0;
            if (!values.next(property.type, value)) {
                return fail("is cut short or not a number");
            }
            cells.push_back(value);
        }
    }
    return {};
}

Expected<void> add_face(const Row& row, long long number, TriangleMesh& mesh)
{
    auto list = row.find("vertex_indices");
    list = list == row.end() ? row.find("vertex_index") : list;
    if (list == row.end()) {
        return refuse("the faces have no list called vertex_indices or vertex_index");
    }
    std::vector<int> corners;
    for (const double index : list->second) {
        if (!(index >= 0 && index < static_cast<double>(mesh.points.size()))) {
            return refuse("face " + std::to_string(number) +
                          " has a point that does not exist: expected numbers below " +
                          std::to_string(mesh.points.size()));
        }
        corners.push_back(static_cast<int>(index));
    }
    add_polygon(corners, mesh);
    return {};
}

Expected<void> add_point(const Row& row, TriangleMesh& mesh)
{
    Vec3 p;
    int axis = 0;
    for (const char* name : {"x", "y", "z"}) {
        const auto cell = row.find(name);
        if (cell == row.end() || cell->second.size() != 1) {
            return refuse("the points have no coordinate called " + std::string(name));
        }
        p[axis++] = cell->second[0];
    }
    mesh.points.push_back(p);
    return {};
}

Expected<void> read_block(const Block& block, Values& values, TriangleMesh& mesh)
{
    Row row;
    for (long long i = 0; i < block.count; ++i) {
        auto ok = read_row(block, i, values, row);
        if (ok && block.name == "vertex") {
            ok = add_point(row, mesh);
        } else if (ok && block.name == "face") {
            ok = add_face(row, i, mesh);
        }
        if (!ok) {
            return ok;
        }
        if (block.properties.empty()) {
            return {}; // nothing to read, however many are announced
        }
    }
    return {};
}

//! The header's line in which something is wrong; 0 when it is complete.
int read_header(TextScanner& scanner, std::string_view bytes, Header& header)
{
    if (bytes.substr(0, 3) != "ply") {
        return 1;
    }
    while (scanner.next_line()) {
        TextScanner line = scanner;
        if (line.word() == "end_header") {
            return 0;
        }
        if (!read_header_line(scanner, header)) {
            return scanner.line_number();
        }
    }
    return scanner.line_number() + 1;
}

} // namespace

Expected<MeshFile> read_ply(std::string_view bytes)
{
    Header header;
    TextScanner scanner(bytes);
    if (const int bad = read_header(scanner, bytes, header); bad != 0) {
        return refuse("line " + std::to_string(bad) + " is not what the header of a PLY file has there");
    }
    Values values(scanner.rest(), header.encoding);
    MeshFile file;
    for (const Block& block : header.blocks) {
        if (auto ok = read_block(block, values, file.mesh); !ok) {
            return tl::make_unexpected(ok.error());
        }
    }
    return file;
}

} // namespace rhombloom
