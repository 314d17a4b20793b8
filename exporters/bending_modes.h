#pragma once

#include "exporters/bent_element.h"

namespace rhombloom {

//! \brief One element's place: its own frame (mirrored when turned over) and its weights of the modes.
struct BentPose
{
    Vec3 origin = Vec3::Zero();                         //!< mm
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); //!< columns; left-handed when turned over
    Eigen::VectorXd weights;                            //!< one per mode, in units of the mode
};

//! \brief All bent elements as one mean shape plus few principal modes: point i of an element is
//! `origin + axes * (mean_i + sum_k weight_k mode_k,i)`.
//! \details Elements of one surface differ little once they are laid upon each other, so few modes say it all.
struct BendingModes
{
    Eigen::VectorXd mean;        //!< 3 numbers per point of the flat sheet, mm
    Eigen::MatrixXd modes;       //!< one column per mode, of length 1, most important first
    std::vector<BentPose> poses; //!< by face number
    //! Mode k moves every point of a sheet's two faces by a multiple of entry k, mm, at most 127 times; empty: by
    //! anything.
    Eigen::VectorXd grain;
};

//! \brief Poses of all elements on their common mean, which is centred on the origin; no modes yet.
BendingModes aligned_elements(const BentSurface& bent);

//! \brief The \p count leading eigenvectors of data * data^T by orthogonal iteration from fixed columns of \p data.
Eigen::MatrixXd principal_directions(const Eigen::MatrixXd& data, int count);

//! \brief The fewest modes, at most \p most, with which no point is off by more than \p tolerance_mm; when that is not
//! enough, \p most of them. See error_mm().
BendingModes bending_modes(const BentSurface& bent, double tolerance_mm, int most);

//! \brief The element's points as the modes give them.
std::vector<Vec3> reconstructed(const BendingModes& modes, const BentPose& pose);

//! \brief The largest distance of a reconstructed point from its place, mm.
double error_mm(const BendingModes& modes, const BentSurface& bent);

} // namespace rhombloom
