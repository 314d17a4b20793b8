#pragma once

#include "core/design/merge_interfaces.h"

namespace rhombloom {

//! \brief One loop of each surface and how they match.
struct SeamChoice
{
    int loop_a = 0; //!< index into Cut::loops
    int loop_b = 0;
    Interface a; //!< shortened as the match demands
    Interface b;
    Correspondence match;
    double squares = 0; //!< sum over the merged vertices of their squared distance, mm2
};

//! \brief A pair of interfaces whose loops all match, with the numbers that rank it.
struct MergeChoice
{
    const MergeInterface* a = nullptr;
    const MergeInterface* b = nullptr;
    std::vector<SeamChoice> seams;
    int loop_size = 0;     //!< vertices of the seams
    int zips = 0;          //!< mountains made one
    double distance = 0;   //!< rms distance of the merged vertices, mm
    double off_union = 0;  //!< mm
    double min_defect = 0; //!< of the merged vertices and zipped valleys, radians
    double max_defect = 0;
    double asymmetry = 0; //!< rms distance of the seam from its image, mm
    double score = 0;     //!< lower is better
};

struct SeamOptions
{
    int zip_variants = 6; //!< ways to shorten a loop that are tried
    int count = 40;       //!< choices wanted
    int pairs = 4000;     //!< of interfaces that are matched at most
    Symmetry symmetry;
};

//! \brief The best choices among all pairs of interfaces, best first. Nothing is built.
std::vector<MergeChoice> best_choices(const std::vector<MergeInterface>& a, const std::vector<MergeInterface>& b,
                                      const Element& element, const SeamOptions& options);

} // namespace rhombloom
