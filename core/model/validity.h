#pragma once

#include "core/model/surface.h"

namespace rhombloom {

//! \brief What is wrong with a surface, one sentence each; empty = it can be built.
struct Validity
{
    std::vector<std::string> problems;
    int boundary_loops = 0;
    int connected_parts = 0;
    int euler_characteristic = 0;

    bool ok() const { return problems.empty(); }
};

//! \brief Sides alternate, interior vertices have valence >= 2 and a permissible defect, all is connected, positions
//! are finite. (Manifoldness and one fan per vertex are guaranteed by make_surface.)
Validity validate(const Surface& surface, const Element& element);

//! \brief The permissible defect violated at interior vertex \p v, as a sentence; empty when it is kept.
std::string defect_problem(const Surface& surface, const Element& element, Vertex v);

} // namespace rhombloom
