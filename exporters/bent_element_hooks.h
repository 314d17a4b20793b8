#pragma once

#include "exporters/bent_element.h"

namespace rhombloom {

//! A point of a hook: which end of which short side, and where in that side's frame.
struct HookPoint
{
    int point = 0;     //!< of the flat sheet
    int node = 0;      //!< the piece's corner at that end
    int far = 0;       //!< and at the other
    double along = 0;  //!< mm from the node along the side
    double beyond = 0; //!< mm outside the nominal side; negative on the element
    double share = 0;  //!< how far it belongs to the neighbour's sheet, 0..1
};

//! \brief A patch's basis at many flat points, one row each: all elements are sampled at the same ones.
struct PatchSamples
{
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, BentPatch::controls, Eigen::RowMajor>;

    Rows at;
    Rows along; //!< differentiated along the unit square's u
    Rows across;

    PatchSamples() = default;
    PatchSamples(const std::vector<Vec2>& points, const Eigen::Matrix2d& to_unit);

    Vec3 position(const BentPatch& patch, int i) const { return (at.row(i) * patch.control.transpose()).transpose(); }
    Vec3 normal(const BentPatch& patch, int i, Outward outward) const;
};

//! \brief The hooks of the piece and where they lie on a neighbour.
struct Hooks
{
    std::vector<HookPoint> points;
    //! Where every hook point lies on the neighbour's piece when its node is the neighbour's corner 0..3: as far from
    //! the node along the neighbour's long side, as far inside.
    std::array<PatchSamples, 4> on_neighbour;
};

Hooks find_hooks(const FlatSheet& sheet, const Element& element, const HookParameters& hooks);

} // namespace rhombloom
