#pragma once

#include "core/design/join.h"

namespace rhombloom {

//! \brief The symmetry that a design declares: a mirror plane or an n-fold axis.
struct Symmetry
{
    enum class Kind
    {
        None,
        Mirror,
        Axis
    };
    Kind kind = Kind::None;
    Vec3 direction = Vec3::UnitX(); //!< normal of the plane, or the axis; any length but 0
    Vec3 through = Vec3::Zero();    //!< mm
    int fold = 2;                   //!< of the axis
};

//! \brief One image of the design: every point moved by \c map, turned inside out when \c mirrors.
struct SymmetryImage
{
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
    bool mirrors = false;
};

//! \brief All images but the identity: one for a mirror, fold - 1 for an axis, none for no symmetry.
std::vector<SymmetryImage> images(const Symmetry& symmetry);

//! \brief The vertex of \p surface at the image of \p v, within a third of la; refused when there is none.
Expected<Vertex> image_vertex(const Surface& surface, const Element& element, const SymmetryImage& image, Vertex v);

//! \brief The element at the image of \p f.
Expected<Face> image_face(const Surface& surface, const Element& element, const SymmetryImage& image, Face f);

//! \brief The same change at the image of its place; corner angles are carried over, so the tags come out mirrored.
Expected<Graft> image_graft(const Surface& surface, const Element& element, const SymmetryImage& image,
                            const Graft& change);

//! \brief \p change and its images. An image that is the change itself (it lies on the plane or axis) is left out;
//! images that overlap otherwise are refused.
Expected<std::vector<Graft>> symmetric_grafts(const Surface& surface, const Element& element, const Symmetry& symmetry,
                                              const Graft& change);

} // namespace rhombloom
