#pragma once

#include "exporters/drawing.h"
#include "exporters/dxf_groups.h"

//! What a R2000 file must hold round its entities so that AutoCAD opens it.
namespace rhombloom::dxf_file {

//! Handles of the objects that every file has; the layers and then the entities follow from `first_free` on.
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

void write_classes(Groups& out);
void write_tables(Groups& out, const Drawing& drawing);
void write_blocks(Groups& out);
void write_objects(Groups& out);

//! \brief The nearest of the AutoCAD colours that have fixed values.
int colour_index(unsigned rgb);

//! \brief The part of a line type's record that both versions share.
void write_line_type(Groups& out, const char* description);

} // namespace rhombloom::dxf_file
