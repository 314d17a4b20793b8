#pragma once

#include "exporters/bent_element_solid.h"
#include "exporters/preview_model.h"

namespace rhombloom {

using Deltas = Eigen::Matrix3Xd; //!< one column per point

//! \brief How finely numbers are written.
struct Grid
{
    double unit = 1e-2;    //!< mm per unit below the groups
    double step = 1e-2;    //!< mm, of positions and of what a weight of 1 moves the fastest point
    int turn_decimals = 4; //!< of quaternions
    int short_steps = 127; //!< targets that reach at most so many steps are written in 8 bits
};

//! A morph target: what is added to points and normals for weight 1.
struct MorphTarget
{
    Deltas points;         //!< whole numbers
    double scale = 1;      //!< units per whole number
    bool one_byte = false; //!< numbers of 8 bits, else 16
    Deltas normals;        //!< empty: none worth storing
    double per_weight = 1; //!< weight of the file, a whole number, per weight of the mode
};

//! \brief The element with its thickness as mean and morph targets, in units of the grid: one per mode, and a last one
//! that lays it flat. No number is written more finely than \p step_mm asks for; see Grid.
struct MorphedElement
{
    Grid grid;
    SolidElement mean; //!< mm
    std::vector<MorphTarget> targets;
};

MorphedElement morphed_element(const PreviewModel& model, double step_mm, int short_steps);

//! \brief Write all targets in the order \p order of the points; the primitive's list of targets.
nlohmann::ordered_json add_targets(Glb& glb, const std::vector<MorphTarget>& targets,
                                   const std::vector<std::uint16_t>& order);

//! \brief A number without ".0" when it is whole: lists of them are most of the file.
nlohmann::ordered_json short_number(double value);

} // namespace rhombloom
