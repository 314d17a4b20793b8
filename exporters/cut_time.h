#pragma once

#include "exporters/drawing.h"
#include "exporters/machines.h"

namespace rhombloom {

//! What a machine does to a drawing.
struct CutWork
{
    double cut = 0;     //!< mm
    double engrave = 0; //!< mm
    double travel = 0;  //!< mm between the paths, from the lower left corner and back
    int pierces = 0;    //!< paths begun, engraved ones included
    double seconds = 0;
};

//! \brief The work in \p drawing when its layers and paths are done in the order given; sheet border and reference
//! are not.
//! \details Speed along an arc is limited by the acceleration, and every corner of more than 5 degrees is a stop.
CutWork cut_work(const Drawing& drawing, const Speeds& speeds);

} // namespace rhombloom
