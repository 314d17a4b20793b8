#pragma once

#include <array>
#include <vector>

#include "core/form/concavity_energy.h"
#include "core/form/embedding.h"
#include "core/form/spring_energy.h"
#include "core/model/surface.h"

namespace rhombloom {

//! \brief All springs between one pair of vertices: two on an interior edge, one on a boundary edge or a diagonal.
struct SpringPair
{
    int a = 0;
    int b = 0;
    int count = 0;
    std::array<double, 2> rest = {0, 0};         //!< in units of la; the second repeats the first when there is one
    std::array<double, 2> inverse_rest = {0, 0}; //!< 1 / rest; 0 when there is no second one
};

//! \brief The energy of DESIGN.md section 3 as lists of terms, in units of la.
//! \details In these units neither the gradient nor the shape depends on the size of the element: an energy in mm is la
//! times the energy here, a gradient is the same number in both.
struct EmbeddingTerms
{
    int vertex_count = 0;
    int free_count = 0;              //!< the vertices from this number on are held: no gradient, no rows in the Hessian
    double la = 0;                   //!< mm
    std::vector<SpringPair> springs; //!< those along edges first
    int edge_count = 0;              //!< how many these are; the others are diagonals
    std::vector<HingeVertices> hinges; //!< one per end of an interior edge
    SpringLaw spring_law;
    HingeLaw hinge_law;
};

//! \details The hinge at a vertex of valence 2 is left out: its two corner triangles coincide and its angle is +-pi
//! whatever the shape.
EmbeddingTerms embedding_terms(const Surface& surface, const Element& element, const EmbedOptions& options);

} // namespace rhombloom
