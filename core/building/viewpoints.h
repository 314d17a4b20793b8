#pragma once

#include "core/building/assembly_plan.h"

namespace rhombloom {

//! \brief A direction to look from: orthonormal, \c up as near to +z as it can be.
struct Viewpoint
{
    Vec3 right = Vec3::UnitX();
    Vec3 up = Vec3::UnitZ();
    Vec3 toward = -Vec3::UnitY(); //!< from the model to the eye
};

//! \brief The directions the booklet draws from: ten round the vertical axis at three heights.
const std::vector<Viewpoint>& viewpoints();

//! Ten azimuths at each height; viewpoint = height * azimuth_count + azimuth.
inline constexpr int azimuth_count = 10;

//! \brief Depth buffers of a surface under construction, one per viewpoint: how well is an element seen?
class Sight
{
public:
    explicit Sight(const Surface& surface);

    //! \brief The element is there from now on and hides what is behind it.
    void place(Face f);

    //! \brief Nothing is there.
    void clear();

    //! \brief Part of \p f, 0..1, that nothing placed hides from \p viewpoint; 0 when it is seen too flat (the cosine
    //! between its normal and the direction to the eye is under 0.3) or from inside.
    double visible(Face f, int viewpoint) const;

    //! \brief The cosine between the element's outward normal and the direction to the eye.
    double facing(Face f, int viewpoint) const;

private:
    struct Pixel
    {
        int index;
        float depth;
    };
    std::vector<std::vector<Pixel>> pixels_; // [viewpoint * faces + face]
    std::vector<std::vector<float>> depth_;  // [viewpoint]
    std::vector<Vec3> normal_;               // [face]
    float tolerance_ = 0;
};

//! \brief Is an element seen well enough to hold the view for it? The part that Sight::visible must reach.
inline constexpr double well_visible = 0.6;

//! \brief A view for each step, changed as seldom as the order allows: a view is held as long as the next elements
//! are well visible in it. Of equally long holds, the one that shows the elements best.
std::vector<int> held_views(const Replay& replay, const AssemblyPlan& plan);

//! \brief How often the view changes.
int count_turns(const std::vector<int>& views);

//! \brief Outward unit normal and centre of an element in its bent shape.
Vec3 element_normal(const Surface& surface, Face f);
Vec3 element_centre(const Surface& surface, Face f);

} // namespace rhombloom
