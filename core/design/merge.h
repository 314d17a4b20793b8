#pragma once

#include "core/design/symmetry.h"
#include "core/form/embedding.h"

namespace rhombloom {

struct MergeOptions
{
    int count = 8;           //!< candidates returned at most
    Symmetry symmetry;       //!< of the design: among equals the symmetric candidate wins
    bool all_images = false; //!< join every image of the second surface, in the same way
    int first_serial = -1;   //!< of the images' elements; -1: the one after the largest
    EmbedOptions embedding;
};

//! \brief One way to join two posed surfaces, with the numbers that ranked it.
struct MergeCandidate
{
    int removed_a = 0; //!< elements of the first surface that go
    int removed_b = 0;
    int loop_size = 0;   //!< vertices of the seams
    int zips = 0;        //!< mountains made one
    double distance = 0; //!< rms distance of the merged vertices in the given pose, mm
    double off_union =
        0; //!< how far elements are kept inside the other surface or missing outside it: sum of depths, mm
    double min_defect = 0; //!< of the merged vertices and zipped valleys, radians
    double max_defect = 0;
    double asymmetry = 0; //!< rms distance of the seam from its image, mm; 0 off the plane or axis
    double score = 0;     //!< lower is better
    Graft change;         //!< of the first surface
};

//! \brief The paper's rule alone (Sec. 4.2): retain or discard the intersecting elements of either surface; the valid
//! ones of these four, best first. Kept for comparison; merge_candidates finds more.
Expected<std::vector<MergeCandidate>> four_candidates(const Surface& a, const Surface& b, const Element& element,
                                                      const MergeOptions& options = {});

//! \brief Ways to join two posed surfaces that intersect, best first.
//! \details The paper tries four pairs of interfaces. Here single elements along the intersection are retained or
//! discarded too, in the order of how far that leaves the union of the inputs, until enough pairs of loops have a
//! compatible correspondence. Refuses, with the reason: no contact, one surface inside the other, no loop, no
//! compatible pair.
Expected<std::vector<MergeCandidate>> merge_candidates(const Surface& a, const Surface& b, const Element& element,
                                                       const MergeOptions& options = {});

struct Merged
{
    Surface surface; //!< embedded, in the pose of the first surface
    EmbedReport embedding;
    MergeCandidate candidate;
    int next_serial = 0; //!< the first serial not used yet
};

//! \brief Merge and embed. Candidates that do not settle, cross themselves or end far from the union of the inputs are
//! passed over; \p index counts the others. For index 0 the best of a few is taken when there is no other.
Expected<Merged> merge(const Surface& a, const Surface& b, const Element& element, int index,
                       const MergeOptions& options = {});

} // namespace rhombloom
