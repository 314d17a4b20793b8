#pragma once

#include "core/building/viewpoints.h"
#include "exporters/drawing.h"

namespace rhombloom {

//! \brief A parallel projection onto the page: points (1/72 inch), y down, about a figure's centre.
struct Camera
{
    Viewpoint view;
    Vec3 look_at = Vec3::Zero(); //!< mm; lands in the figure's centre
    double scale = 1;            //!< points per mm
};

//! \brief Where \p p lies on the paper, relative to the figure's centre.
Vec2 project(const Camera& camera, const Vec3& p);

//! \brief Distance toward the eye, mm.
double depth(const Camera& camera, const Vec3& p);

using Matrix34 = Eigen::Matrix<double, 3, 4>;

//! \brief The camera as it is written into plan.json: times (x, y, z, 1) in mm gives the point on the page, in points
//! from its LOWER left corner with y up, and the depth toward the eye in mm.
//! \param centre the figure's centre on the page, y down
Matrix34 page_matrix(const Camera& camera, const Vec2& centre, double page_height);

//! \brief How the model is turned from one view to the next.
struct Turn
{
    double round = 0; //!< degrees about the vertical axis, positive = the model's front moves to the right
    double tilt = 0;  //!< degrees, positive = the model's top tips toward the reader

    bool none() const { return round == 0 && tilt == 0; }
};

Turn turn_between(int from_view, int to_view);

//! \brief The largest camera scale that keeps \p faces within half-sizes \p half from each of \p views, looking at the
//! middle of their bounding box.
Camera fitted_camera(const Surface& surface, const std::vector<Face>& faces, const std::vector<int>& views,
                     const Vec2& half);

} // namespace rhombloom
