#pragma once

#include <array>
#include <string>
#include <vector>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
// After the mesh: the traits below use Eigen points.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include <Eigen/Core>

#include "core/model/element.h"

namespace rhombloom {

using Vec3 = Eigen::Vector3d;

struct SurfaceTraits : OpenMesh::DefaultTraits
{
    using Point = Vec3;
    using Normal = Vec3;
    VertexAttributes(0);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
    EdgeAttributes(0);
    FaceAttributes(0);
    VertexTraits
    {
        Side side = Side::Long; //!< of the half-edges that leave this vertex
    };
    FaceTraits
    {
        Facing facing = Facing::Front;
        int component = 0; //!< index into Surface::components
        int serial = -1;   //!< names the element for as long as it exists in a history
    };
};

//! \brief The connected thing: an oriented manifold quad mesh, one face per element (Sec. 3.1). Positions in mm.
class Surface : public OpenMesh::PolyMesh_ArrayKernelT<SurfaceTraits>
{
public:
    std::vector<std::string> components = {"body"}; //!< names; every face belongs to one
};

using Vertex = Surface::VertexHandle;
using Halfedge = Surface::HalfedgeHandle;
using Edge = Surface::EdgeHandle;
using Face = Surface::FaceHandle;
using Quad = std::array<int, 4>;

//! \brief The same as lists: what generators make, operations cut and join, and files store.
//! \details Quads are counter-clockwise seen from outside. \c facing, \c component and \c serial have one entry per
//! quad, \c sides one per vertex.
struct SurfaceLists
{
    std::vector<Vec3> positions;
    std::vector<Side> sides;
    std::vector<Quad> quads;
    std::vector<Facing> facing;
    std::vector<int> component;
    std::vector<int> serial;
    std::vector<std::string> components = {"body"};
};

//! \brief Build the half-edge mesh. Numbers of vertices and faces are kept, and face f starts at quads[f][0].
//! \details Refuses, with the numbers, a quad with a repeated or unknown vertex, an edge with more than two faces or
//! two faces of opposite orientation, a vertex touched by two fans of faces, an isolated vertex, a short-short edge.
Expected<Surface> make_surface(const SurfaceLists& lists);

SurfaceLists lists(const Surface& surface);

//! \brief Side of a half-edge: Short or Long, derived from the vertex it leaves.
inline Side side(const Surface& surface, Halfedge h)
{
    return surface.data(surface.from_vertex_handle(h)).side;
}

//! \brief The vertices of face \p f, counter-clockwise; side k of the element runs from vertex k to vertex k + 1.
Quad quad(const Surface& surface, Face f);

//! \brief The half-edge that is side \p k (0..3) of face \p f.
Halfedge side_halfedge(const Surface& surface, Face f, int k);

//! \brief The inverse of side_halfedge: which side (0..3) of its face half-edge \p h is.
int side_index(const Surface& surface, Halfedge h);

//! \brief The angle of face f's corner at v, alpha or beta, of the undeformed element.
double corner_angle(const Surface& surface, const Element& element, Face f, Vertex v);

} // namespace rhombloom
