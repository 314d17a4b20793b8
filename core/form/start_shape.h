#pragma once

#include "core/form/embedding_energy.h"

namespace rhombloom {

//! Repairs of positions that no descent could start from, and of those in which one has got stuck. Positions are three
//! coordinates per vertex in units of la. Everything here is deterministic.

//! \brief The vertices that each vertex shares a spring with.
std::vector<std::vector<int>> spring_neighbours(const EmbeddingTerms& terms);

//! \brief Scale about the origin so that the springs have their rest length on average. Not if all vertices coincide.
void rescale(const EmbeddingTerms& terms, Eigen::VectorXd& x);

//! \brief Replace every vertex by the mean of itself and its spring neighbours, \p passes times, and rescale.
void smooth(const EmbeddingTerms& terms, Eigen::VectorXd& x, int passes);

//! \brief Mirror in the plane through the origin that the shape is flattest along: convex and concave change places.
void mirror(Eigen::VectorXd& x);

//! \brief Number of dimensions, 0 to 3, in which the vertices spread by more than a millionth of the largest extent.
int spread_dimensions(const Eigen::VectorXd& x);

//! \brief Lift the middle of a flat sheet, on the side that makes it convex.
void bulge(const EmbeddingTerms& terms, Eigen::VectorXd& x);

//! \brief Move vertices apart that coincide with a spring neighbour.
void separate(const EmbeddingTerms& terms, Eigen::VectorXd& x);

//! \brief Positions from the connectivity alone: the three slowest modes of the graph of edges (a round shape for
//! closed surfaces), oriented so that convex is cheaper.
Eigen::VectorXd spectral_layout(const EmbeddingTerms& terms);

//! \brief Positions from the connectivity alone: distances as nearly those along the surface as space allows (stress
//! majorisation, Gansner et al. 2004), oriented so that the volume is positive.
//! \details Each \p variant begins elsewhere; every other one in six dimensions, of which three are squeezed out
//! slowly, so that limbs pass by each other. Finds the hole of a torus, though not from every beginning. Takes a time
//! and a memory of n^2.
Eigen::VectorXd distance_layout(const EmbeddingTerms& terms, int variant);

//! \brief The smallest hinge angle; 0 when there is no hinge.
double sharpest_concavity(const EmbeddingTerms& terms, const Eigen::VectorXd& x);

//! \brief Mirror every region inside a rim of sharply concave hinges in the plane of its rim; false when there is none.
//! \details A dimple in a thin shell is nearly its own mirror image (Pogorelov), so this is where it pops out to.
bool pop_dimples(const EmbeddingTerms& terms, Eigen::VectorXd& x);

} // namespace rhombloom
