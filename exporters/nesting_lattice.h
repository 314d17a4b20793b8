#pragma once

#include <vector>

#include "exporters/nesting_no_fit.h"

namespace rhombloom::nesting {

//! \brief Two vectors that repeat a cell without overlap.
struct Lattice
{
    Vec2 v1 = Vec2::Zero();
    Vec2 v2 = Vec2::Zero();

    double cell() const { return std::abs(cross_2d(v1, v2)); }
};

//! \brief The same lattice spanned by its two shortest vectors (Gauss's reduction), v1 the shorter.
Lattice reduced(Lattice lattice);

//! \brief May a cell with the no-fit region \p self be repeated by \p lattice?
bool admissible(const Lattice& lattice, const NoFit& self);

//! \brief How densely the search samples.
struct LatticeSearch
{
    int samples = 200;   //!< first vectors, spread over half the no-fit boundary besides its corners
    double worst = 1.12; //!< largest cell kept, as a multiple of the smallest found
    int keep = 400;      //!< lattices returned at most
    bool between = true; //!< also second vectors that touch one neighbour only
};

//! \brief Admissible lattices of a cell with the no-fit region \p self, smallest cell first.
//! \details The first vector runs along the boundary of \p self, so that neighbours touch; the second lies on the
//! boundary too, outside of \p self moved by all multiples of the first. In the densest lattice it lies where two of
//! those boundaries cross (Milenkovic, Computational Geometry 22, 2002).
std::vector<Lattice> lattices(const NoFit& self, const LatticeSearch& search);

} // namespace rhombloom::nesting
