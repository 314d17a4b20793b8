#pragma once

#include <string_view>
#include <vector>

#include "core/expected.h"
#include "exporters/drawing.h"

//! Entities of a DXF file and the curves among them that become chords.
namespace rhombloom::reading {

//! A line pair of the file.
struct DxfGroup
{
    int code = 0;
    std::string_view value;
};

//! One entity: its kind and its groups.
struct DxfEntity
{
    std::string_view kind;
    std::vector<DxfGroup> groups;
};

//! \brief A whole file's line pairs up to EOF; refuses binary files and lines that are no group codes.
Expected<std::vector<DxfGroup>> dxf_groups(std::string_view bytes);

//! \brief The entities of the section of this name.
std::vector<DxfEntity> dxf_entities(const std::vector<DxfGroup>& groups, std::string_view section);

//! \brief The number of a group, NaN for what is none.
double dxf_number(const DxfGroup& group);

//! \brief The first number with this code.
double dxf_value(const DxfEntity& entity, int code, double otherwise);

//! \brief The first text with this code, or an empty one.
std::string_view dxf_text(const DxfEntity& entity, int code);

//! \brief The point at \p code and \p code + 10; NaN where it is missing.
Vec2 dxf_point(const DxfEntity& entity, int code);

//! \brief Chords of an ELLIPSE, whole or in part, within \p tolerance (drawing units).
Expected<Path> dxf_ellipse(const DxfEntity& entity, double tolerance);

//! \brief Chords of a SPLINE with control points, rational or not, within \p tolerance (drawing units); refuses one
//! that has fit points alone.
Expected<Path> dxf_spline(const DxfEntity& entity, double tolerance);

} // namespace rhombloom::reading
