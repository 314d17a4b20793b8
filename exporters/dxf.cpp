#include "exporters/dxf.h"

#include <array>
#include <climits>

#include "core/text.h"

namespace rhombloom {

namespace {

//! Handles of the objects that every R2000 file has; the layers and the entities follow from `first_free` on.
namespace handle {
constexpr int vport_table = 0x1, ltype_table = 0x2, layer_table = 0x3, style_table = 0x4, view_table = 0x5;
constexpr int ucs_table = 0x6, appid_table = 0x7, dimstyle_table = 0x8, block_record_table = 0x9;
constexpr int root = 0xC, groups = 0xD, layouts = 0xE, plot_styles = 0xF, plot_style = 0x10;
constexpr int vport = 0x11, by_block = 0x12, by_layer = 0x13, continuous = 0x14, layer_0 = 0x15, style = 0x16;
constexpr int appid = 0x17, dimstyle = 0x18;
constexpr int model = 0x20, model_begin = 0x21, model_end = 0x22, model_layout = 0x23;
constexpr int paper = 0x24, paper_begin = 0x25, paper_end = 0x26, paper_layout = 0x27;
constexpr int first_free = 0x30;
} // namespace handle

std::string hex(int value)
{
    std::string text;
    for (; value > 0; value /= 16) {
        text.insert(text.begin(), "0123456789ABCDEF"[value % 16]);
    }
    return text.empty() ? "0" : text;
}

//! Appends group codes and their values, a line each.
class Groups
{
public:
    Groups& text(int code, const std::string& value)
    {
        const std::string digits = std::to_string(code);
        text_ += std::string(digits.size() < 3 ? 3 - digits.size() : 0, ' ') + digits + "\n" + value + "\n";
        return *this;
    }
    Groups& integer(int code, int value) { return text(code, std::to_string(value)); }
    Groups& reference(int code, int handle) { return text(code, hex(handle)); }
    Groups& real(int code, double value, int decimals = 5)
    {
        const std::string digits = to_fixed(value, decimals);
        return text(code, digits.find('.') == std::string::npos ? digits + ".0" : digits);
    }
    //! The group codes of y and z are those of x plus 10 and 20.
    Groups& xy(int code, double x, double y) { return real(code, x).real(code + 10, y); }
    Groups& xyz(int code, double x, double y, double z = 0) { return xy(code, x, y).real(code + 20, z); }
    Groups& subclass(const char* name) { return text(100, name); }
    //! The start of an object that has a handle and an owner.
    Groups& object(const char* type, int handle, int owner)
    {
        return text(0, type).reference(5, handle).reference(330, owner);
    }
    Groups& table(const char* name, int handle, int count)
    {
        text(0, "TABLE").text(2, name);
        return reference(5, handle).reference(330, 0).subclass("AcDbSymbolTable").integer(70, count);
    }
    Groups& record(const char* type, int handle, int table, const char* subclass_name, const std::string& name)
    {
        object(type, handle, table).subclass("AcDbSymbolTableRecord").subclass(subclass_name);
        return text(2, name).integer(70, 0);
    }
    Groups& section(const char* name) { return text(0, "SECTION").text(2, name); }
    Groups& end_section() { return text(0, "ENDSEC"); }
    Groups& end_table() { return text(0, "ENDTAB"); }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
};

//! The nearest of the AutoCAD colours that have fixed values. 7 is black on white paper, white on a black screen.
int colour_index(unsigned rgb)
{
    struct Indexed
    {
        int index;
        unsigned rgb;
    };
    constexpr std::array<Indexed, 12> colours = {{{7, 0x000000},
                                                  {1, 0xFF0000},
                                                  {2, 0xFFFF00},
                                                  {3, 0x00FF00},
                                                  {4, 0x00FFFF},
                                                  {5, 0x0000FF},
                                                  {6, 0xFF00FF},
                                                  {8, 0x808080},
                                                  {9, 0xC0C0C0},
                                                  {30, 0xFF7F00},
                                                  {140, 0x00BFFF},
                                                  {200, 0xBF00FF}}};
    int best = 7;
    int least = INT_MAX;
    for (const Indexed& c : colours) {
        int distance = 0;
        for (const int shift : {0, 8, 16}) {
            const int difference = static_cast<int>((c.rgb >> shift) & 255) - static_cast<int>((rgb >> shift) & 255);
            distance += difference * difference;
        }
        if (distance < least) {
            least = distance;
            best = c.index;
        }
    }
    return best;
}

//! One line of plain ASCII: the code page of old files holds nothing else for sure.
std::string comment(const std::string& note)
{
    std::string text;
    for (const char c : note) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20) {
            text += ' ';
        } else if (byte < 0x80) {
            text += c;
        } else if (byte >= 0xC0) {
            text += '?'; // one for a whole UTF-8 sequence
        }
    }
    return text;
}

void write_header(Groups& out, const Drawing& drawing, DxfVersion version, int handle_seed)
{
    const bool r12 = version == DxfVersion::R12;
    for (const std::string& note : drawing.notes) {
        out.text(999, comment(note));
    }
    out.section("HEADER").text(9, "$ACADVER").text(1, r12 ? "AC1009" : "AC1015");
    out.text(9, "$DWGCODEPAGE").text(3, r12 ? "ascii" : "ANSI_1252");
    if (!r12) {
        out.text(9, "$HANDSEED").reference(5, handle_seed);
    }
    out.text(9, "$INSBASE").xyz(10, 0, 0);
    out.text(9, "$EXTMIN").xyz(10, 0, 0).text(9, "$EXTMAX").xyz(10, drawing.width, drawing.height);
    out.text(9, "$LIMMIN").xy(10, 0, 0).text(9, "$LIMMAX").xy(10, drawing.width, drawing.height);
    // Not official before R2000, but the readers that know the two also obey them in R12.
    out.text(9, "$INSUNITS").integer(70, 4).text(9, "$MEASUREMENT").integer(70, 1);
    out.end_section();
}

void write_classes(Groups& out)
{
    const std::array<std::array<const char*, 2>, 3> classes = {{{"ACDBDICTIONARYWDFLT", "AcDbDictionaryWithDefault"},
                                                                {"ACDBPLACEHOLDER", "AcDbPlaceHolder"},
                                                                {"LAYOUT", "AcDbLayout"}}};
    out.section("CLASSES");
    for (const auto& [record, cpp_class] : classes) {
        out.text(0, "CLASS").text(1, record).text(2, cpp_class).text(3, "ObjectDBX Classes");
        out.integer(90, 0).integer(280, 0).integer(281, 0);
    }
    out.end_section();
}

void write_view(Groups& out, const Drawing& drawing)
{
    out.xy(10, 0, 0).xy(11, 1, 1).xy(12, drawing.width / 2, drawing.height / 2).xy(13, 0, 0).xy(14, 10, 10);
    out.xy(15, 10, 10).xyz(16, 0, 0, 1).xyz(17, 0, 0, 0).real(40, drawing.height * 1.1).real(41, 1.5);
    out.real(42, 50).real(43, 0).real(44, 0).real(50, 0).real(51, 0);
    for (const auto& [code, value] :
         {std::pair{71, 0}, {72, 1000}, {73, 1}, {74, 3}, {75, 0}, {76, 0}, {77, 0}, {78, 0}}) {
        out.integer(code, value);
    }
}

void write_line_type(Groups& out, const char* description)
{
    out.text(3, description).integer(72, 65).integer(73, 0).real(40, 0);
}

bool plotted(const Layer& layer)
{
    return layer.use != LayerUse::Sheet && layer.use != LayerUse::Reference;
}

void write_layers(Groups& out, const Drawing& drawing)
{
    constexpr const char* record = "AcDbLayerTableRecord";
    out.table("LAYER", handle::layer_table, static_cast<int>(drawing.layers.size()) + 1);
    out.record("LAYER", handle::layer_0, handle::layer_table, record, "0");
    out.integer(62, 7).text(6, "Continuous").integer(370, -3).reference(390, handle::plot_style);
    int next = handle::first_free;
    for (const Layer& layer : drawing.layers) {
        out.record("LAYER", next++, handle::layer_table, record, layer.name);
        out.integer(62, colour_index(layer.rgb)).text(6, "Continuous");
        if (!plotted(layer)) {
            out.integer(290, 0);
        }
        out.integer(370, 0).reference(390, handle::plot_style);
    }
    out.end_table();
}

void write_tables(Groups& out, const Drawing& drawing)
{
    constexpr const char* ltype = "AcDbLinetypeTableRecord";
    out.section("TABLES").table("VPORT", handle::vport_table, 1);
    out.record("VPORT", handle::vport, handle::vport_table, "AcDbViewportTableRecord", "*Active");
    write_view(out, drawing);
    out.end_table().table("LTYPE", handle::ltype_table, 3);
    write_line_type(out.record("LTYPE", handle::by_block, handle::ltype_table, ltype, "ByBlock"), "");
    write_line_type(out.record("LTYPE", handle::by_layer, handle::ltype_table, ltype, "ByLayer"), "");
    write_line_type(out.record("LTYPE", handle::continuous, handle::ltype_table, ltype, "Continuous"), "Solid line");
    out.end_table();
    write_layers(out, drawing);
    out.table("STYLE", handle::style_table, 1);
    out.record("STYLE", handle::style, handle::style_table, "AcDbTextStyleTableRecord", "Standard");
    out.real(40, 0).real(41, 1).real(50, 0).integer(71, 0).real(42, 2.5).text(3, "txt").text(4, "");
    out.end_table().table("VIEW", handle::view_table, 0).end_table();
    out.table("UCS", handle::ucs_table, 0).end_table();
    out.table("APPID", handle::appid_table, 1);
    out.record("APPID", handle::appid, handle::appid_table, "AcDbRegAppTableRecord", "ACAD").end_table();
    // A dimension style's handle is in group 105, alone of all.
    out.table("DIMSTYLE", handle::dimstyle_table, 1).subclass("AcDbDimStyleTable").text(0, "DIMSTYLE");
    out.reference(105, handle::dimstyle).reference(330, handle::dimstyle_table).subclass("AcDbSymbolTableRecord");
    out.subclass("AcDbDimStyleTableRecord").text(2, "Standard").integer(70, 0).end_table();
    out.table("BLOCK_RECORD", handle::block_record_table, 2);
    constexpr const char* block = "AcDbBlockTableRecord";
    for (const auto& [name, own, layout] : {std::tuple{"*Model_Space", handle::model, handle::model_layout},
                                            std::tuple{"*Paper_Space", handle::paper, handle::paper_layout}}) {
        out.object("BLOCK_RECORD", own, handle::block_record_table).subclass("AcDbSymbolTableRecord");
        out.subclass(block).text(2, name).reference(340, layout);
    }
    out.end_table().end_section();
}

void write_block(Groups& out, const char* name, int record, int begin, int end)
{
    out.object("BLOCK", begin, record).subclass("AcDbEntity").text(8, "0").subclass("AcDbBlockBegin").text(2, name);
    out.integer(70, 0).xyz(10, 0, 0).text(3, name).text(1, "");
    out.object("ENDBLK", end, record).subclass("AcDbEntity").text(8, "0").subclass("AcDbBlockEnd");
}

void write_blocks(Groups& out)
{
    out.section("BLOCKS");
    write_block(out, "*Model_Space", handle::model, handle::model_begin, handle::model_end);
    write_block(out, "*Paper_Space", handle::paper, handle::paper_begin, handle::paper_end);
    out.end_section();
}

void write_lwpolyline(Groups& out, const Path& path, const std::string& layer, int own)
{
    out.object("LWPOLYLINE", own, handle::model).subclass("AcDbEntity").text(8, layer).subclass("AcDbPolyline");
    out.integer(90, static_cast<int>(path.vertices.size())).integer(70, path.closed ? 1 : 0).real(43, 0);
    for (const PathVertex& v : path.vertices) {
        out.xy(10, v.point.x(), v.point.y());
        if (v.bulge != 0) {
            out.real(42, v.bulge, 9);
        }
    }
}

void write_polyline(Groups& out, const Path& path, const std::string& layer)
{
    out.text(0, "POLYLINE").text(8, layer).integer(66, 1).xyz(10, 0, 0).integer(70, path.closed ? 1 : 0);
    for (const PathVertex& v : path.vertices) {
        out.text(0, "VERTEX").text(8, layer).xyz(10, v.point.x(), v.point.y());
        if (v.bulge != 0) {
            out.real(42, v.bulge, 9);
        }
    }
    out.text(0, "SEQEND").text(8, layer);
}

void write_entities(Groups& out, const Drawing& drawing, DxfVersion version)
{
    int next = handle::first_free + static_cast<int>(drawing.layers.size());
    out.section("ENTITIES");
    for (const Layer& layer : drawing.layers) {
        for (const Path& path : layer.paths) {
            if (path.vertices.size() < 2) {
                continue;
            }
            if (version == DxfVersion::R12) {
                write_polyline(out, path, layer.name);
            } else {
                write_lwpolyline(out, path, layer.name, next++);
            }
        }
    }
    out.end_section();
}

void write_layout(Groups& out, const char* name, int own, int block_record, int tab)
{
    out.object("LAYOUT", own, handle::layouts).subclass("AcDbPlotSettings").text(1, "").text(2, "none_device");
    out.text(4, "").text(6, "");
    for (int code = 40; code <= 49; ++code) {
        out.real(code, 0);
    }
    out.real(140, 0).real(141, 0).real(142, 1).real(143, 1).integer(70, tab == 0 ? 1712 : 688).integer(72, 1);
    out.integer(73, 0).integer(74, 5).text(7, "").integer(75, 16).real(147, 1).real(148, 0).real(149, 0);
    out.subclass("AcDbLayout").text(1, name).integer(70, 1).integer(71, tab).xy(10, 0, 0).xy(11, 420, 297);
    out.xyz(12, 0, 0).xyz(14, 0, 0).xyz(15, 0, 0).real(146, 0).xyz(13, 0, 0).xyz(16, 1, 0).xyz(17, 0, 1);
    out.integer(76, 0).reference(330, block_record);
}

void write_objects(Groups& out)
{
    out.section("OBJECTS").object("DICTIONARY", handle::root, 0).subclass("AcDbDictionary").integer(281, 1);
    out.text(3, "ACAD_GROUP").reference(350, handle::groups).text(3, "ACAD_LAYOUT").reference(350, handle::layouts);
    out.text(3, "ACAD_PLOTSTYLENAME").reference(350, handle::plot_styles);
    out.object("DICTIONARY", handle::groups, handle::root).subclass("AcDbDictionary").integer(281, 1);
    out.object("DICTIONARY", handle::layouts, handle::root).subclass("AcDbDictionary").integer(281, 1);
    out.text(3, "Model").reference(350, handle::model_layout).text(3, "Layout1").reference(350, handle::paper_layout);
    out.object("ACDBDICTIONARYWDFLT", handle::plot_styles, handle::root).subclass("AcDbDictionary").integer(281, 1);
    out.text(3, "Normal").reference(350, handle::plot_style);
    out.subclass("AcDbDictionaryWithDefault").reference(340, handle::plot_style);
    out.object("ACDBPLACEHOLDER", handle::plot_style, handle::plot_styles);
    write_layout(out, "Model", handle::model_layout, handle::model, 0);
    write_layout(out, "Layout1", handle::paper_layout, handle::paper, 1);
    out.end_section();
}

//! R12 needs no more than its layers.
void write_r12_tables(Groups& out, const Drawing& drawing)
{
    out.section("TABLES").text(0, "TABLE").text(2, "LTYPE").integer(70, 1);
    out.text(0, "LTYPE").text(2, "CONTINUOUS").integer(70, 0);
    write_line_type(out, "Solid line");
    out.end_table().text(0, "TABLE").text(2, "LAYER").integer(70, static_cast<int>(drawing.layers.size()) + 1);
    out.text(0, "LAYER").text(2, "0").integer(70, 0).integer(62, 7).text(6, "CONTINUOUS");
    for (const Layer& layer : drawing.layers) {
        out.text(0, "LAYER").text(2, layer.name).integer(70, 0);
        out.integer(62, colour_index(layer.rgb)).text(6, "CONTINUOUS");
    }
    out.end_table().end_section();
}

int handle_seed(const Drawing& drawing)
{
    std::size_t count = drawing.layers.size();
    for (const Layer& layer : drawing.layers) {
        count += layer.paths.size();
    }
    return handle::first_free + static_cast<int>(count) + 1;
}

} // namespace

std::string dxf(const Drawing& drawing, DxfVersion version)
{
    Groups out;
    write_header(out, drawing, version, handle_seed(drawing));
    if (version == DxfVersion::R12) {
        write_r12_tables(out, drawing);
    } else {
        write_classes(out);
        write_tables(out, drawing);
        write_blocks(out);
    }
    write_entities(out, drawing, version);
    if (version == DxfVersion::R2000) {
        write_objects(out);
    }
    return out.text(0, "EOF").take();
}

} // namespace rhombloom
