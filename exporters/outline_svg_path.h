#pragma once

#include <string_view>
#include <vector>

#include "core/expected.h"
#include "exporters/drawing.h"

namespace rhombloom::reading {

//! \brief x' = a x + c y + e, y' = b x + d y + f, as SVG writes a matrix.
struct Affine
{
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

    Vec2 operator*(const Vec2& p) const { return {a * p.x() + c * p.y() + e, b * p.x() + d * p.y() + f}; }
    Affine operator*(const Affine& inner) const;
    double determinant() const { return a * d - b * c; }
    double scale() const; //!< the largest stretch
    bool keeps_circles() const;
};

//! \brief What turns the numbers of path data into millimetres; counts the curves that had to become chords.
struct Pen
{
    Affine to_mm;
    bool curves = false;
};

//! \brief Paths of an SVG `d` attribute, in mm; the refusal quotes the place.
Expected<std::vector<Path>> svg_path(std::string_view data, Pen& pen);

//! \brief The numbers of an SVG attribute, or nothing when something else is in it.
Expected<std::vector<double>> svg_numbers(std::string_view text);

//! \brief Append an elliptic arc (SVG's A command, user units) to \p path (mm), whose last vertex is the image of \p
//! from.
struct SvgArc
{
    double rx = 0, ry = 0, rotation = 0; //!< rotation in radians
    bool large = false, sweep = false;
};
void add_svg_arc(Path& path, const Vec2& from, const Vec2& to, const SvgArc& arc, Pen& pen);

} // namespace rhombloom::reading
