#pragma once

#include "core/design/interface.h"
#include "core/design/overlap.h"
#include "core/design/symmetry.h"

namespace rhombloom {

//! \brief One of the ways to cut a surface where it meets another one.
struct MergeInterface
{
    Cut cut;
    double off_union = 0; //!< sum of the depths of the elements that are kept inside or missing outside, mm
};

//! \brief What is known of one surface where it meets the other.
struct MeetingSide
{
    const Surface& surface;
    std::vector<char> intersecting; //!< per element
    std::vector<char> outside;      //!< per element: not intersecting and outside the other surface
    std::vector<Face> band;         //!< intersecting elements and their neighbours, that may be retained or discarded
    std::vector<double> depth;      //!< per element of the band: signed distance from the other surface, mm
    std::vector<std::vector<int>> choices; //!< indices into the band of what is retained or discarded together
};

MeetingSide merge_side(const Surface& surface, const std::vector<char>& intersecting, const Surface& other);

//! \brief Let each element of the band share the fate of its images, so that every interface is symmetric.
//! \details Returns false and changes nothing when the band is not symmetric.
bool tie_images(MeetingSide& side, const Element& element, const Symmetry& symmetry);

//! \brief The paper's two: the intersecting elements discarded, and retained where they touch elements outside.
std::vector<MergeInterface> paper_interfaces(const MeetingSide& side, const Element& element);

//! \brief Interfaces near the intersection in the order of \c off_union: each of the side's choices is retained or
//! discarded. At most \p count, found among the first \p tries subsets.
std::vector<MergeInterface> nearby_interfaces(const MeetingSide& side, const Element& element, int count, int tries);

} // namespace rhombloom
