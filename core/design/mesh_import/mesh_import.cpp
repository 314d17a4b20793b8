#include "core/design/mesh_import/mesh_import.h"

#include <algorithm>
#include <cmath>

#include "core/design/mesh_import/join_network.h"
#include "core/design/mesh_import/network.h"
#include "core/design/mesh_import/remesh.h"
#include "core/design/pose.h"
#include "core/model/angular_defect.h"
#include "core/model/validity.h"
#include "core/text.h"

namespace rhombloom {

namespace {

// Diagonals are shorter at rest than on paper: the bowed long sides pull at them.
constexpr double diagonal_share = 0.97;

double triangle_edge(const Element& element)
{
    return diagonal_share * long_diagonal(element);
}

//! Mean area of a target per element, when the triangles have sides of length \p edge.
double area_per_element(double edge)
{
    return edge * edge * std::sqrt(3.0) / 6;
}

int max_degree(const Element& element)
{
    const double room = two_pi - permissible_defect(element).min;
    return static_cast<int>(std::floor(room / element.alpha + 1e-9));
}

} // namespace

Expected<ImportedMesh> import_mesh(const TriangleMesh& mesh, const ImportOptions& options)
{
    ImportedMesh result;
    result.element = options.element;
    const int wanted = options.size.elements.value_or(600);
    const double edge = triangle_edge(result.element);
    TriangleMesh target = mesh;
    const double factor = std::sqrt(wanted * area_per_element(edge) / area(target));
    transform(target, factor, Vec3::Zero());
    const MeshTree tree(target);
    RemeshOptions remeshing;
    remeshing.max_degree = max_degree(result.element);
    remeshing.edge = edge;
    TriangleMesh triangles;
    for (int i = 0; i < 6; ++i) {
        triangles = remesh(i == 0 ? target : triangles, tree, remeshing);
        const double count = 1.5 * static_cast<double>(triangles.triangles.size());
        if (std::abs(count / wanted - 1) < 0.02) {
            break;
        }
        remeshing.edge *= std::sqrt(count / wanted);
    }
    auto surface = make_surface(join_network(triangles, tree));
    if (!surface) {
        return tl::make_unexpected(surface.error());
    }
    result.report.embedding = embed_in_place(*surface, result.element, options.embedding);
    const Eigen::Affine3d pose = fit(*surface, tree, true);
    const double scale = std::cbrt(pose.linear().determinant());
    for (const Vertex v : surface->vertices()) {
        surface->set_point(v, pose * surface->point(v) / scale);
    }
    transform(target, 1 / scale, Vec3::Zero());
    result.target = target;
    result.report.distance = distance(*surface, MeshTree(target));
    result.report.la = result.element.la;
    result.report.elements = static_cast<int>(surface->n_faces());
    result.report.elements_asked = wanted;
    result.report.scale = factor / scale;
    result.report.defects = defect_range(*surface, result.element);
    result.operation = import_of(*surface, options.id);
    return result;
}

} // namespace rhombloom
