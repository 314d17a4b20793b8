#pragma once

#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

//! \brief How the triangles of a mesh hang together.
struct Shells
{
    std::vector<int> shell;      //!< of each triangle: those joined by edges that two triangles share
    int count = 0;               //!< number of shells
    int boundary_edges = 0;      //!< edges of one triangle
    int crowded_edges = 0;       //!< edges of three or more triangles
    std::vector<bool> one_sided; //!< of each shell: its triangles cannot be made to agree
};

//! \brief Find the shells of \p mesh and turn triangles so that neighbours agree; in each closed shell so that they
//! face outward.
Shells orient_shells(TriangleMesh& mesh);

//! \brief Give every fan of triangles its own point, where several touch in one.
//! \return the number of points added.
int split_fans(TriangleMesh& mesh);

//! \brief The closed rings of boundary edges, with the surface on their left.
//! \pre no crowded edges, neighbours agree and fans are split.
std::vector<std::vector<int>> boundary_rings(const TriangleMesh& mesh);

} // namespace rhombloom
