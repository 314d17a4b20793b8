#pragma once

#include "core/design/mesh_import/triangle_mesh.h"

namespace rhombloom {

//! \brief The point of a mesh that is nearest to another point.
struct NearestPoint
{
    Vec3 point = Vec3::Zero();
    int triangle = -1;
    double distance = 0;
};

//! \brief Answers "what of this mesh is nearest?" and "inside or outside?" in logarithmic time: a tree of boxes.
//! \details Keeps its own copy of the mesh. Reading from several threads is safe.
class MeshTree
{
public:
    explicit MeshTree(TriangleMesh mesh);

    const TriangleMesh& mesh() const { return mesh_; }

    //! \param hint A triangle that is likely to be near, if one is known: the answer is the same, and sooner there.
    NearestPoint nearest(const Vec3& p, int hint = -1) const;

    //! \brief Generalised winding number (Jacobson et al. 2013): 1 inside, 0 outside a closed mesh, in between where it
    //! has holes. Far groups of triangles count as one dipole (Barill et al. 2018), good to a few hundredths.
    double winding_number(const Vec3& p) const;

    //! \brief Every point p becomes factor * p + shift.
    void transform(double factor, const Vec3& shift);

    //! \brief Unit normal of triangle \p t.
    const Vec3& normal(int t) const { return normals_[t]; }

private:
    struct Node
    {
        Eigen::AlignedBox3d box;
        int first = 0; //!< of order_
        int count = 0; //!< 0: an inner node
        int left = -1; //!< the right child follows it
    };

    //! What a node's triangles add to the winding number from afar.
    struct Dipole
    {
        Vec3 moment = Vec3::Zero();
        Vec3 centre = Vec3::Zero();
        double area = 0;
        double radius = 0;
    };

    void build(int node, int first, int count, int left, int threads);
    void make_leaf(int node, int first, int count);
    void sum_up(int node);

    TriangleMesh mesh_;
    std::vector<Vec3> normals_;
    std::vector<Vec3> middles_;
    std::vector<int> order_;
    std::vector<std::array<Vec3, 3>> corners_; //!< of the triangles, in the order of order_
    std::vector<Node> nodes_;
    std::vector<Dipole> dipoles_; //!< of the nodes
};

//! \brief The point of the triangle a, b, c nearest to \p p.
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace rhombloom
