#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// After the mesh: the traits below use Eigen points.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include "core/design/mesh_import/mesh_tree.h"

namespace rhombloom {

struct EditTraits : OpenMesh::DefaultTraits
{
    using Point = Vec3;
    using Normal = Vec3;
    VertexAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};

//! \brief Triangles under change: edges can be split, collapsed and flipped.
using EditMesh = OpenMesh::TriMesh_ArrayKernelT<EditTraits>;

//! \pre \p mesh is an oriented manifold.
EditMesh edit_mesh(const TriangleMesh& mesh);

TriangleMesh triangle_mesh(EditMesh& mesh);

double edge_length(const EditMesh& mesh, EditMesh::EdgeHandle e);

double mean_edge_length(const EditMesh& mesh);

//! \brief The two vertices opposite to an inner edge.
std::array<EditMesh::VertexHandle, 2> opposite_vertices(const EditMesh& mesh, EditMesh::EdgeHandle e);

//! \brief May inner edge \p e be flipped without folding the surface or doubling an edge?
bool may_flip(const EditMesh& mesh, EditMesh::EdgeHandle e);

//! \brief May the vertex that \p h leaves move to \p where, without folding a triangle over, if the triangles of \p h
//! vanish? \p h invalid: none vanishes.
bool may_move(const EditMesh& mesh, EditMesh::VertexHandle v, const Vec3& where, EditMesh::VertexHandle vanishing);

//! \brief Is \p v the tip of a limb: 2 pi minus the angles there above 100 degrees? Moved along the surface, tips would
//! slide down their limbs.
bool is_tip(const EditMesh& mesh, EditMesh::VertexHandle v);

} // namespace rhombloom
