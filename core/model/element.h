#pragma once

#include <optional>

#include "core/expected.h"
#include "core/units.h"

namespace rhombloom {

//! The two lengths of side; in a surface, the length of the half-edges that leave a vertex (DESIGN.md section 2).
enum class Side : unsigned char
{
    Short,
    Long
};

//! Front, or turned over (the paper's F/B tag, Sec. 3.1).
enum class Facing : unsigned char
{
    Front,
    Back
};

//! Closed interval of angular defects, radians.
struct DefectRange
{
    double min = 0;
    double max = 0;
};

//! \brief The one rhomboid piece that every surface is built from (Sec. 3.1). Lengths in mm, angles in radians.
struct Element
{
    double la = 80;                 //!< short side
    double lb = 88;                 //!< long side
    double alpha = radians(63.435); //!< acute angle
    double thickness = 0.5;         //!< of the sheet

    //! Narrower limits for the angular defect than the paper's, if the design asks for them.
    std::optional<DefectRange> defect_limits = std::nullopt;
};

//! \brief The obtuse angle, pi - alpha.
double beta(const Element& element);

//! \brief la or lb.
double side_length(const Element& element, Side side);

//! \brief The diagonal that joins the two obtuse corners.
double short_diagonal(const Element& element);

//! \brief The diagonal that joins the two acute corners.
double long_diagonal(const Element& element);

//! \brief The angle of the corner at a vertex of side \p side in an element that faces \p facing: alpha or beta.
double corner_angle(const Element& element, Side side, Facing facing);

//! \brief Defects a vertex may have: [2 pi - 4 beta - alpha, 2 pi - 2 alpha] (Sec. 3.2), or the element's own limits.
DefectRange permissible_defect(const Element& element);

//! \brief Refuse sizes that no sheet could have; the message names the value and the allowed range.
Expected<void> check(const Element& element);

} // namespace rhombloom
