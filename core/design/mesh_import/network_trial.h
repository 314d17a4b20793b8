#pragma once

#include <optional>

#include "core/design/mesh_import/network_search.h"

namespace rhombloom {

//! \brief What all trials of one search have in common.
struct Trials
{
    const MeshTree& target;
    const Element& element;
    const SearchOptions& options;
    int max_iterations = 2000; //!< of the embedding of one trial; what has not settled by then is no good
};

//! \brief A triangulation, the network made of it, and how good that is.
struct Trial
{
    TriangleMesh triangles;    //!< corners where they settled, on the target as it was searched
    std::vector<Vec3> middles; //!< of the triangles, where they settled
    FoundNetwork found;
    std::vector<double> stretch; //!< of each element: the largest of its sides and diagonals
    double score = 0;            //!< small is good: distance in la, and a price for what cannot be built
};

//! \brief Embed the join of \p triangles and judge it. Empty when that is no surface or has impermissible defects.
std::optional<Trial> settle(const TriangleMesh& triangles, const std::vector<Vec3>& middles, const Trials& trials);

//! \brief Change the triangulation where elements are overstretched or far from the target, one flip or split at a
//! time, as long as the score falls.
void polish(Trial& best, const Trials& trials, int max_degree);

} // namespace rhombloom
