#pragma once

#include <map>
#include <memory>
#include <mutex>

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

//! \brief Which pixels each element of a surface covers from each viewpoint, and at what depth. Does not change while
//! the surface is built, so it is made once and shared.
class Coverage
{
public:
    struct Pixel
    {
        int index;
        float depth; //!< toward the eye
    };

    explicit Coverage(const Surface& surface);

    const std::vector<Pixel>& pixels(Face f, int viewpoint) const
    {
        return pixels_[static_cast<std::size_t>(viewpoint) * normal_.size() + f.idx()];
    }

    const Vec3& normal(Face f) const { return normal_[f.idx()]; }
    float tolerance() const { return tolerance_; }

private:
    std::vector<std::vector<Pixel>> pixels_; // [viewpoint * faces + face]
    std::vector<Vec3> normal_;               // [face]
    float tolerance_ = 0;
};

//! \brief The coverage of each stage of a replay, made when it is first asked for. May be asked from several threads.
class StageCoverage
{
public:
    explicit StageCoverage(const Replay& replay) : replay_(replay) {}
    std::shared_ptr<const Coverage> operator()(int stage);

private:
    const Replay& replay_;
    std::mutex making_;
    std::map<int, std::shared_ptr<const Coverage>> made_;
};

//! \brief Depth buffers of a surface under construction, one per viewpoint: how well is an element seen?
class Sight
{
public:
    explicit Sight(std::shared_ptr<const Coverage> coverage);

    //! \brief The element is there from now on and hides what is behind it.
    void place(Face f);

    //! \brief Nothing is there.
    void clear();

    //! \brief Part of \p f, 0..1, that nothing placed hides from \p viewpoint; 0 when it is seen too flat (the cosine
    //! between its normal and the direction to the eye is under 0.3) or from inside.
    double visible(Face f, int viewpoint) const;

private:
    std::shared_ptr<const Coverage> coverage_;
    std::vector<std::vector<float>> depth_; // [viewpoint]
};

//! \brief Is an element seen well enough to hold the view for it? The part that Sight::visible must reach.
inline constexpr double well_visible = 0.6;

//! \brief A view for each step, changed as seldom as the order allows: a view is held as long as the next elements
//! are well visible in it. Of equally long holds, the one that shows the elements best.
std::vector<int> held_views(const Replay& replay, const AssemblyPlan& plan);
std::vector<int> held_views(const Replay& replay, const AssemblyPlan& plan, StageCoverage& coverage);

//! \brief How often the view changes.
int count_turns(const std::vector<int>& views);

//! \brief Outward unit normal and centre of an element in its bent shape.
Vec3 element_normal(const Surface& surface, Face f);
Vec3 element_centre(const Surface& surface, Face f);

} // namespace rhombloom
