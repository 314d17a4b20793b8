#pragma once

#include <string>

#include "exporters/drawing.h"

namespace rhombloom {

enum class DxfVersion
{
    R2000, //!< AC1015, LWPOLYLINE; for everything that can read it
    R12    //!< AC1009, POLYLINE/VERTEX; for old and simple readers (Silhouette Studio, dime)
};

//! \brief The drawing as ASCII DXF: every path one polyline whose arcs are bulges, 1 unit = 1 mm, y up.
//! \details The two versions are never mixed: a R12 header with LWPOLYLINE makes readers drop the layers. R2000 is
//! complete (classes, tables, blocks, layouts, handles), because AutoCAD refuses less. Layer colours are the nearest of
//! the named AutoCAD colours; sheet and reference layers do not plot. The notes are comments before the first section.
std::string dxf(const Drawing& drawing, DxfVersion version = DxfVersion::R2000);

} // namespace rhombloom
