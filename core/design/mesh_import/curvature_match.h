#pragma once

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

struct MatchOptions
{
    double edge = 1;          //!< length that all edges should have, in the mesh's unit
    int max_degree = 7;       //!< most triangles at a vertex
    double regularity = 1e-3; //!< price of a vertex whose degree is not 6, against the squared misfit of the metric
    //! Price of two vertices of degree 7 or more that face each other across an edge; twice that for neighbours.
    double crowding = 0;
    double temperature = 0; //!< rise of the misfit that is accepted now and then, in the first round
    double cooling = 0.85;  //!< factor on the temperature from round to round
    int rounds = 24;
    unsigned seed = 1;
};

//! \brief Change the degrees of a triangulation until equilateral triangles fit the target's metric.
//! \details Equilateral triangles with d of them at a vertex have the curvature (6 - d) pi / 3 there. Where that
//! differs from the target's, lengths are off by a factor exp(u), Laplacian(u) = the difference, and the surface ends
//! away from its target: on a sphere of 600 elements the distance is correlated with u, smoothed over an edge's length,
//! by 0.93 to 0.97. Edges are flipped to lower the sum of those squares (annealed, the same way every time), then
//! points relax along the target, over and over. Where two vertices of degree 7 are close, elements stretch the most
//! (on a sphere of 1,200 elements those at 12 % of such vertices when alone, at 33 to 100 % with another one near),
//! so that has a price.
void match_curvature(TriangleMesh& triangles, const MeshTree& target, const MatchOptions& options);

//! \brief Let the points slide on \p target until the edges, as springs, are in balance.
void relax_springs(TriangleMesh& triangles, const MeshTree& target, double edge, int sweeps);

//! \brief Curvature of a closed mesh at each of its points: 2 pi minus the angles there.
std::vector<double> point_curvature(const TriangleMesh& mesh);

} // namespace rhombloom
