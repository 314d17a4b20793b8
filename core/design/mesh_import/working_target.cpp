#include "core/design/mesh_import/working_target.h"

#include <cmath>

#include "core/design/mesh_import/close_gaps.h"
#include "core/design/mesh_import/mesh_decimate.h"
#include "core/design/mesh_import/network_search.h"
#include "core/design/mesh_import/remesh.h"
#include "core/design/mesh_import/thicken.h"

namespace rhombloom {

namespace {

constexpr double detail = 6; // triangles' edges of the working target per edge of the network
//! Of the thinnest limb, in edges of the network: tubes of three triangles around do not settle, or bend at their
//! roots.
constexpr double least_radius = 0.35;
//! Of the narrowest gap, in edges of the network: walls nearer to each other would cross.
constexpr double least_gap = 0.45;

} // namespace

double least_thickness(const Element& element)
{
    return 2 * least_radius * triangle_edge(element);
}

double least_gap_width(const Element& element)
{
    return least_gap * triangle_edge(element);
}

WorkingTarget working_target(const TriangleMesh& target, double edge, int elements)
{
    constexpr int most_rounds = 4;
    constexpr double near = 0.05; // what is thickened or filled may be that much less so in the end
    WorkingTarget result;
    TriangleMesh scaled = decimate(target, edge / (2 * detail));
    for (int round = 1; round <= most_rounds; ++round) {
        // In triangles that are small for the network and even: quick to ask, whatever the file had.
        result.even = evened(MeshTree(scaled), edge / detail);
        ThickenedMesh thickened = thicken(result.even, {least_radius * edge, edge / detail});
        GapsClosed closed = close_gaps(thickened.mesh, {least_gap * edge, edge / detail});
        result.thick = std::move(closed.mesh);
        result.thickened = thickened.share;
        result.filled = closed.share;
        const double count = area(result.thick) / area_per_element(edge);
        result.elements = elements > 0 ? elements : static_cast<int>(std::lround(count));
        const double factor = std::sqrt(result.elements / count);
        if (elements == 0 || result.thickened + result.filled == 0) {
            break;
        }
        result.scale *= factor;
        if (std::abs(factor - 1) < near || round == most_rounds) {
            transform(result.even, factor, Vec3::Zero());
            transform(result.thick, factor, Vec3::Zero());
            break;
        }
        transform(scaled, factor, Vec3::Zero());
    }
    return result;
}

} // namespace rhombloom
