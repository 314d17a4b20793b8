#include "exporters/dxf.h"

#include "exporters/dxf_frame.h"

namespace rhombloom {

namespace {

using namespace dxf_file;

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
