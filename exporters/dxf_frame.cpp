#include "exporters/dxf_frame.h"

#include <array>
#include <climits>
#include <tuple>

namespace rhombloom::dxf_file {

namespace {

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

void write_block(Groups& out, const char* name, int record, int begin, int end)
{
    out.object("BLOCK", begin, record).subclass("AcDbEntity").text(8, "0").subclass("AcDbBlockBegin").text(2, name);
    out.integer(70, 0).xyz(10, 0, 0).text(3, name).text(1, "");
    out.object("ENDBLK", end, record).subclass("AcDbEntity").text(8, "0").subclass("AcDbBlockEnd");
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

} // namespace

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

void write_line_type(Groups& out, const char* description)
{
    out.text(3, description).integer(72, 65).integer(73, 0).real(40, 0);
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

void write_blocks(Groups& out)
{
    out.section("BLOCKS");
    write_block(out, "*Model_Space", handle::model, handle::model_begin, handle::model_end);
    write_block(out, "*Paper_Space", handle::paper, handle::paper_begin, handle::paper_end);
    out.end_section();
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

} // namespace rhombloom::dxf_file
